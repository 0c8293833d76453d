#pragma once

#include <string>

#include <visualization_msgs/Marker.h>

#include "sdf_ccd/body.h"
#include "sdf_ccd/result.h"

namespace sdf_ccd {

std_msgs::ColorRGBA toColor(float r, float g, float b, float a);

/// Blue, yellow, vermilion and purple of Okabe and Ito's palette, which colour-blind people can tell apart: CLEAR,
/// UNCERTAIN, CONTACT, NOT_CHECKED.
std_msgs::ColorRGBA verdictColor(Verdict verdict, float alpha);

/// A marker to be added, at its frame's origin. Its time is 0, so that rviz draws it with the latest transforms.
visualization_msgs::Marker makeMarker(const std::string& frame, const std::string& name, int id, int type);

/// Deletes all markers of a topic.
visualization_msgs::Marker deleteAllMarker(const std::string& frame);

/// Gives a marker the shape that is checked; half-spaces become a thin square of 4 m. A mesh is sent as its URI if rviz
/// can load that, else as triangles: a URI is short enough to be sent with every new colour.
void setShape(const GeometryDescription& geometry, visualization_msgs::Marker& marker);

/// The pose of that marker in the body's frame.
Isometry3d markerPose(const GeometryDescription& geometry);

/// Sets a list of the mesh's triangles.
void setTriangles(const TriangleMesh& mesh, visualization_msgs::Marker& marker);

}  // namespace sdf_ccd
