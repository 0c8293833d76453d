#pragma once

#include <string>

#include <visualization_msgs/Marker.h>

#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

std_msgs::ColorRGBA toColor(float r, float g, float b, float a);

/// Blue, yellow, vermilion and purple of Okabe and Ito's palette, which colour-blind people tell apart: CLEAR,
/// UNCERTAIN, CONTACT, NOT_CHECKED.
std_msgs::ColorRGBA verdictColor(Verdict verdict, float alpha);

/// A marker to be added, at its frame's origin. Its time is 0, so that rviz draws it with its latest transforms.
visualization_msgs::Marker makeMarker(const std::string& frame, const std::string& name, int id, int type);

/// Gives a marker the shape that is checked; half-spaces as a thin square of 4 m. A mesh is named, if it is one that
/// rviz finds under its name, else told triangle by triangle: a name is short enough to be sent with every new colour.
void setShape(const GeometryDescription& geometry, visualization_msgs::Marker& marker);

/// Triangle by triangle.
void setTriangles(const TriangleMesh& mesh, visualization_msgs::Marker& marker);

}  // namespace sdf_ccd
