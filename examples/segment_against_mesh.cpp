// Builds the field of a mesh and finds when a moving point is inside the mesh.
#include <cmath>
#include <cstdio>

#include <sdf_ccd/field.h>
#include <sdf_ccd/mesh.h>
#include <sdf_ccd/primitive.h>
#include <sdf_ccd/segments.h>

int main(int argc, char** argv) {
  using namespace sdf_ccd;
  constexpr double kRadius = 0.1;  // [m]
  const TriangleMesh mesh = argc > 1 ? loadMesh(argv[1]) : tessellate(Sphere{kRadius}, 1e-4);

  FieldOptions options;
  options.max_error = 1e-4;  // [m]
  const DistanceField field = buildField(orientOutward(mesh).mesh, options);
  std::printf("%zu cells, %.2f MB, error at most %.3g m\n", field.cells(), 1e-6 * double(field.bytes()),
              field.errorBound());

  // A segment through the centre of the mesh; it starts and ends half the mesh's size outside.
  const AlignedBox3d box = field.surfaceBox();
  const Vector3d half_path(box.sizes().x(), 0.0, 0.0);
  const Intervals inside = segmentIntervals(field, {box.center() - half_path, box.center() + half_path});
  for (const Interval& interval : inside) std::printf("inside from %.6f to %.6f\n", interval.enter, interval.exit);

  if (argc > 1) return 0;
  const bool is_right = inside.size() == 1 && std::abs(inside[0].enter - 0.25) < 1e-3 &&
                        std::abs(inside[0].exit - 0.75) < 1e-3;  // for a sphere, by symmetry
  return is_right ? 0 : 1;
}
