#include <memory>

#include <gtest/gtest.h>

#include "mesh/content_hash.h"
#include "oracle/shapes.h"
#include "oracle/xxh64_twin.h"
#include "scene/geometry_keys.h"

namespace sdf_ccd::shared_mesh_test {

using MeshPointer = std::shared_ptr<const TriangleMesh>;

MeshPointer pointerTo(const TriangleMesh& mesh) {
  return std::make_shared<const TriangleMesh>(mesh);
}

BodyDescription bodyOf(const MeshPointer& mesh) {
  BodyDescription body;
  body.geometry.push_back({mesh, Isometry3d::Identity(), "mesh"});
  return body;
}

// A twin that was sent first, as junk far away, once took the place of the part that came later.
TEST(SharedMesh, ATwinOfEqualXxh64IsNeverTakenForThePart) {
  const TriangleMesh part = test::boxMesh({0.1, 0.2, 0.3});
  std::vector<BodyDescription> junk = {bodyOf(pointerTo(test::xxh64Twin(part)))}, robot = {bodyOf(pointerTo(part))};
  GeometryKeys keys;
  EXPECT_NE(keys.keyOf(junk[0]), keys.keyOf(robot[0]));
  shareMeshes(junk);
  shareMeshes(robot);
  EXPECT_TRUE(areIdentical(*std::get<MeshPointer>(robot[0].geometry[0].shape), part));
}

TEST(SharedMesh, EqualMeshesBecomeOne) {
  std::vector<BodyDescription> bodies = {bodyOf(pointerTo(test::boxMesh({0.1, 0.2, 0.3}))),
                                         bodyOf(pointerTo(test::boxMesh({0.1, 0.2, 0.3})))};
  GeometryKeys keys, others;
  EXPECT_EQ(keys.keyOf(bodies[0]), others.keyOf(bodies[1]));
  shareMeshes(bodies);
  EXPECT_EQ(std::get<MeshPointer>(bodies[0].geometry[0].shape), std::get<MeshPointer>(bodies[1].geometry[0].shape));
}

// Even if SHA-256 failed: the meshes themselves are compared.
TEST(SharedMesh, MeshesUnderOneHashAreCompared) {
  WeakStore<TriangleMesh> store;
  const MeshPointer first = pointerTo(test::boxMesh({0.1, 0.2, 0.3})), same = pointerTo(*first),
                    other = pointerTo(test::boxMesh({0.1, 0.2, 0.4}));
  EXPECT_EQ(sharedMesh(store, "hash", first), first);
  EXPECT_EQ(sharedMesh(store, "hash", same), first);
  EXPECT_EQ(sharedMesh(store, "hash", other), nullptr);
  EXPECT_EQ(sharedMesh(store, "another", other), other);
}

}  // namespace sdf_ccd::shared_mesh_test
