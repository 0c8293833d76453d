#include "adversarial/drawn.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "oracle/drawn_meshes.h"
#include "oracle/shapes.h"

namespace sdf_ccd::test {
namespace {

using Corners = std::vector<Vector3d>;

TriangleMesh block(const Vector3d& low, const Vector3d& high) {
  return translated(boxMesh(0.5 * (high - low)), 0.5 * (low + high));
}

TriangleMesh joined(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes) all = merged(std::move(all), mesh);
  return all;
}

TriangleMesh face(const Corners& corners) {
  TriangleMesh mesh{corners, {}};
  for (int k = 1; k + 1 < int(corners.size()); ++k) mesh.triangles.emplace_back(0, k, k + 1);
  return mesh;
}

Actor actor(const std::string& kind, const TriangleMesh& mesh, Pieces solid, Pieces reach = {}) {
  return {kind,
          {{std::make_shared<const TriangleMesh>(mesh), Isometry3d::Identity(), kind}},
          std::move(solid),
          std::move(reach)};
}

const TriangleMesh& meshOf(const Actor& body) {
  return *std::get<std::shared_ptr<const TriangleMesh>>(body.geometry.at(0).shape);
}

/// The walls between an outer and an inner box, given by half sizes.
Pieces walls(const Vector3d& outer, const Vector3d& inner, bool has_lid = true) {
  Pieces pieces;
  for (int k = 0; k < 3; ++k) {
    for (const int side : {-1, 1}) {
      if (k == 2 && side == 1 && !has_lid) continue;
      Vector3d low = -outer, high = outer;
      (side > 0 ? low : high)[k] = side * inner[k];
      pieces.push_back(convexOf(block(low, high)));
    }
  }
  return pieces;
}

/// A triangle in x and y, extruded along z.
TriangleMesh prism(const Vector3d& a, const Vector3d& b, const Vector3d& c, double half) {
  const Vector3d up(0, 0, half);
  return {{a - up, b - up, c - up, a + up, b + up, c + up},
          {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};
}

Actor ofFaces(const std::string& kind, const std::vector<Corners>& faces, bool from_both_sides = false) {
  std::vector<TriangleMesh> meshes;
  Pieces pieces;
  for (const Corners& corners : faces) {
    meshes.push_back(face(corners));
    if (from_both_sides) meshes.push_back(flipped(face(corners)));
    pieces.push_back(polygon(corners));
  }
  return actor(kind, welded(joined(meshes)), std::move(pieces));
}

/// The part of the half-space z < 0 that bodies can reach, as a pyramid: within reach, the plane is its nearest face.
TriangleMesh solidBelow() {
  return {{{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}, {0, 0, -30}},
          {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}}};
}

/// Adds a box as another part of the body.
void addBox(const Vector3d& half, const Vector3d& place, Actor& body) {
  Isometry3d X_BG = Isometry3d::Identity();
  X_BG.translation() = place;
  body.geometry.push_back({Primitive(Box::fromSize(2.0 * half)), X_BG, "part"});
  body.solid.push_back(convexOf(translated(boxMesh(half), place)));
}

const Vector3d kOuter(0.2, 0.15, 0.1), kInner(0.17, 0.12, 0.07);

}  // namespace

Actor hollowBox() {
  return actor("hollow box", joined({boxMesh(kOuter), flipped(boxMesh(kInner))}), walls(kOuter, kInner));
}

Actor nestedBoxes() {
  return actor("nested boxes", joined({boxMesh(kOuter), boxMesh(kInner)}), walls(kOuter, kInner),
               {convexOf(boxMesh(kOuter))});
}

Actor invertedBox() {
  return actor("inverted box", flipped(boxMesh(kOuter)), {convexOf(boxMesh(kOuter))});
}

Actor bowTie() {
  const Vector3d middle(0, 0, 0);
  const TriangleMesh large = prism(middle, {-0.3, 0.2, 0}, {-0.3, -0.2, 0}, 0.1),
                     small = prism(middle, {0.15, -0.1, 0}, {0.15, 0.1, 0}, 0.1);
  return actor("bow-tie", welded(joined({large, flipped(small)})), {convexOf(large), convexOf(small)});
}

Actor overlaidLobe() {
  const CrossedTetrahedra crossed;
  const TriangleMesh over = block({0.05, -0.2, -0.2}, {0.3, 0.2, 0.2});
  return actor("overlaid lobe", merged(crossed.mesh, over),
               {convexOf(crossed.large), convexOf(crossed.small), convexOf(over)});
}

Actor membrane() {
  return ofFaces("membrane", {{{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0.2, 0.2, 0}, {-0.2, 0.2, 0}}});
}

Actor doubleMembrane() {
  Actor both = ofFaces("double membrane", {{{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0.2, 0.2, 0}, {-0.2, 0.2, 0}}}, true);
  return both;
}

Actor wheel() {
  constexpr int kCorners = 24;
  constexpr double kRadius = 0.3, kHalf = 0.05;
  std::vector<TriangleMesh> meshes;
  Pieces pieces;
  Corners web;
  const auto at = [&](int k, double z) {
    const double angle = 2.0 * kPi * k / kCorners;
    return Vector3d(kRadius * std::cos(angle), kRadius * std::sin(angle), z);
  };
  for (int k = 0; k < kCorners; ++k) {
    const Corners rim{at(k, -kHalf), at((k + 1) % kCorners, -kHalf), at((k + 1) % kCorners, kHalf), at(k, kHalf)};
    meshes.push_back(face(rim));
    pieces.push_back(polygon(rim));
    web.push_back(at(k, 0.0));
  }
  meshes.push_back(face(web));
  meshes.push_back(flipped(face(web)));
  pieces.push_back(polygon(web));
  return actor("wheel", welded(joined(meshes)), std::move(pieces));
}

/// Faces of a box without its lid.
std::vector<Corners> binFaces() {
  const double x = 0.2, y = 0.15, z = 0.1;
  return {{{-x, -y, -z}, {-x, y, -z}, {x, y, -z}, {x, -y, -z}},
          {{-x, -y, -z}, {x, -y, -z}, {x, -y, z}, {-x, -y, z}},
          {{x, -y, -z}, {x, y, -z}, {x, y, z}, {x, -y, z}},
          {{x, y, -z}, {-x, y, -z}, {-x, y, z}, {x, y, z}},
          {{-x, y, -z}, {-x, -y, -z}, {-x, -y, z}, {-x, y, z}}};
}

Actor openBin() {
  return ofFaces("open bin", binFaces());
}

Actor paddedBin() {
  Actor bin = openBin();
  bin.kind = "padded bin";
  addBox({0.1, 0.08, 0.01}, {0.0, 0.0, -0.09}, bin);
  return bin;
}

Actor thickBin() {
  // The outer box and the inner one inside out, both without their lids, and a rim between them.
  const Vector3d inner(kInner.x(), kInner.y(), kOuter.z());
  TriangleMesh cavity = boxMesh(inner);
  for (Vector3d& v : cavity.vertices) v.z() = v.z() < 0 ? -kInner.z() : kOuter.z();
  TriangleMesh mesh = joined({boxMesh(kOuter), flipped(cavity)});
  std::vector<Vector3i> kept;
  for (const Vector3i& t : mesh.triangles) {
    const auto on_top = [&](int v) { return mesh.vertices[v].z() == kOuter.z(); };
    if (!on_top(t[0]) || !on_top(t[1]) || !on_top(t[2])) kept.push_back(t);
  }
  mesh.triangles = kept;
  const int ring[] = {4, 5, 7, 6};  // corners of the top, counterclockwise
  for (int k = 0; k < 4; ++k) {
    const int a = ring[k], b = ring[(k + 1) % 4];
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + 8}, {a, b + 8, a + 8}});
  }
  Pieces pieces = walls(kOuter, kInner, false);
  return actor("thick bin", mesh, std::move(pieces));
}

Actor coveredBlock() {
  // A block, half inside a bin that lies on its rim and whose faces face inward.
  std::vector<Corners> faces = binFaces();
  for (Corners& corners : faces) {
    for (Vector3d& p : corners) p.tail<2>() *= -1.0;
    std::reverse(corners.begin(), corners.end());
  }
  const Actor cover = ofFaces("cover", faces);
  const TriangleMesh within = block({-0.1, -0.08, -0.2}, {0.1, 0.08, 0.05});
  Pieces pieces = cover.solid;
  pieces.push_back(convexOf(within));
  return actor("covered block", merged(meshOf(cover), within), std::move(pieces));
}

Actor sharedEdge() {
  const TriangleMesh a = block({-0.2, -0.2, -0.1}, {0, 0, 0.1}), b = block({0, 0, -0.1}, {0.2, 0.2, 0.1});
  return actor("shared edge", welded(joined({a, b})), {convexOf(a), convexOf(b)});
}

Actor sharedFace() {
  const TriangleMesh a = block({-0.2, -0.1, -0.1}, {0, 0.1, 0.1}), b = block({0, -0.1, -0.1}, {0.2, 0.1, 0.1});
  return actor("shared face", welded(joined({a, b})), {convexOf(a), convexOf(b)});
}

Actor overlapping() {
  const TriangleMesh a = block({-0.2, -0.1, -0.1}, {0.1, 0.1, 0.1}), b = block({-0.05, -0.05, -0.2}, {0.2, 0.05, 0.05});
  return actor("overlapping", joined({a, b}), {convexOf(a), convexOf(b)});
}

Actor fins() {
  std::vector<Corners> faces;
  for (int k = 0; k < 3; ++k) {
    const Vector3d out(0.2 * std::cos(2.0 * kPi * k / 3), 0.2 * std::sin(2.0 * kPi * k / 3), 0.0), up(0, 0, 0.15);
    faces.push_back({-up, out - up, out + up, up});
  }
  return ofFaces("fins", faces);
}

Actor voxel() {
  Actor one = convexActor("voxel", boxMesh(Vector3d::Constant(0.025)));
  one.geometry[0].watertight_voxels = one.is_field_only = true;
  return one;
}

Actor voxels() {
  const double s = 0.05;
  const TriangleMesh all[] = {block({0, 0, 0}, {s, s, s}), block({s, 0, 0}, {2 * s, s, s}),
                              block({0, s, 0}, {s, 2 * s, s})};
  // Only the boundary: faces between two voxels are removed.
  TriangleMesh mesh = welded(joined({all[0], all[1], all[2]}));
  std::vector<Vector3i> kept;
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d p = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    const bool inner = (p.x() == s && p.y() < s) || (p.y() == s && p.x() < s);
    if (!inner) kept.push_back(t);
  }
  mesh.triangles = kept;
  Actor body = actor("voxels", mesh, {convexOf(all[0]), convexOf(all[1]), convexOf(all[2])});
  body.geometry[0].watertight_voxels = body.is_field_only = true;
  return body;
}

Actor clusters() {
  const double s = 0.025;
  const TriangleMesh a = translated(boxMesh({s, s, s}), {-0.4, 0, 0}),
                     b = translated(boxMesh({s, s, s}), {0.4, 0.1, 0});
  Actor body = actor("clusters", merged(a, b), {convexOf(a), convexOf(b)});
  body.geometry[0].watertight_voxels = body.is_field_only = true;
  return body;
}

Actor beads() {
  const TriangleMesh a = translated(icosphere(0.02, 0), {-0.4, 0, 0}),
                     b = translated(icosphere(0.02, 0), {0.4, 0.1, 0});
  return actor("beads", merged(a, b), {convexOf(a), convexOf(b)});
}

Actor ground() {
  return {"ground",
          {{Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), Isometry3d::Identity(), "ground"}},
          {convexOf(solidBelow())},
          {},
          false,
          true};
}

Actor groundAndPost() {
  Actor body = ground();
  body.kind = "ground and post";
  std::get<HalfSpace>(std::get<Primitive>(body.geometry[0].shape)).offset = -1.0;
  body.solid = {convexOf(translated(solidBelow(), {0, 0, -1}))};
  addBox({0.03, 0.02, 0.03}, Vector3d::Zero(), body);
  return body;
}

Actor mapAndPost() {
  Actor body = voxel();
  body.kind = "map and post";
  body.is_convex = false;
  addBox({0.03, 0.02, 0.03}, {0.3, 0.0, 0.1}, body);
  return body;
}

Actor groove() {
  Actor body = ground();
  body.kind = "groove";
  const Isometry3d turned(Eigen::AngleAxisd(0.5 * kPi, Vector3d::UnitX()));
  body.geometry.push_back({Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), turned, "wall"});
  body.solid = {convexOf(solidBelow()), convexOf(transformed(solidBelow(), turned))};
  return body;
}

Actor sleeve() {
  Actor body = link();
  body.kind = "sleeve";
  body.is_convex = false;
  addBox({0.05, 0.15, 0.04}, {0.1, 0.05, 0.02}, body);
  addBox({0.03, 0.02, 0.03}, {-0.1, 0.0, 0.0}, body);
  return body;
}

Actor link() {
  return convexActor("link", boxMesh({0.2, 0.1, 0.08}));
}

Actor bead() {
  return convexActor("bead", icosphere(0.02, 0));
}

Actor rod() {
  return boxActor({0.01, 0.01, 0.2});
}

std::vector<Actor> drawnActors() {
  return {voxel(),        link(),       bead(),        bowTie(),        openBin(),    wheel(),          rod(),
          voxels(),       hollowBox(),  nestedBoxes(), invertedBox(),   membrane(),   doubleMembrane(), thickBin(),
          sharedEdge(),   sharedFace(), overlapping(), fins(),          clusters(),   beads(),          overlaidLobe(),
          coveredBlock(), paddedBin(),  ground(),      groundAndPost(), mapAndPost(), groove(),         sleeve()};
}

}  // namespace sdf_ccd::test
