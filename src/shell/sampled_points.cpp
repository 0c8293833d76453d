#include "sampled_points.h"

#include "shell/point_shell.h"

namespace sdf_ccd {

PointShell toShell(const SampledPoints& sampled) {
  AlignedBox3d box;
  for (const Vector3d& p : sampled.points) box.extend(p);
  return toShell(sampled, box.isEmpty() ? Vector3d(Vector3d::Zero()) : Vector3d(box.center()));
}

PointShell toShell(const SampledPoints& sampled, const Vector3d& origin) {
  PointShell shell;
  shell.origin = origin;
  shell.offsets.reserve(sampled.size());
  shell.normals.reserve(sampled.size());
  shell.areas.reserve(sampled.size());
  for (std::size_t i = 0; i < sampled.size(); ++i)
    shell.add(sampled.points[i], sampled.normals[i].cast<double>(), sampled.areas[i]);
  shell.covering_radius = sampled.covering_radius + shell.position_error;
  shell.edge_radius = sampled.edge_radius + shell.position_error;
  shell.flatness = sampled.flatness;
  return shell;
}

}  // namespace sdf_ccd
