#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "measure.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd::benchmark {

/// What the command line of every study can set; a study takes what concerns it.
struct StudyOptions {
  bool quick = false;
  std::vector<std::string> mesh_files;                        ///< NAME=FILE
  std::vector<std::string> meshes;                            ///< names; only those, all if empty
  std::vector<std::string> paper_meshes{"bunny3k", "torus"};  ///< those that the paper's dense grids are built for
  std::vector<std::string> robots;                            ///< NAME=URDF[,SRDF]
  std::string bag;                                            ///< a robot's motion, of the study `anytime`
  std::vector<std::string> cases;                             ///< only those, all if empty
  std::vector<std::string> systems;                           ///< of the study `monitor`; all if empty
  std::vector<int> cells;                                     ///< uniform fields: cells along the longest side
  std::vector<std::string> errors;   ///< fields to a maximum error, in box sides; as text, it names the case
  std::size_t segments = 1'000'000;  ///< random segments per case
  long motions = 1'000'000;          ///< per family of the study `truth`
  int pairs = 1000;                  ///< random pose pairs per case
  int cycles = 10'000;               ///< of a millisecond, per case of the study `monitor`
  std::string plots;                 ///< directory for a study's own plots; none if empty
  MeasureOptions measure;
};

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;  ///< oriented outward
};

/// True for a name that is among `wanted`, or if nothing in particular is wanted.
bool isWanted(const std::vector<std::string>& wanted, const std::string& name);

/// The robots that are given, or else this one.
inline std::vector<std::string> robotsOr(const StudyOptions& options, const std::string& otherwise) {
  return options.robots.empty() ? std::vector<std::string>{otherwise} : options.robots;
}

/// The meshes that are wanted and at hand; a torus and a box of our own if there is none.
/// @throws std::invalid_argument for a file argument of another form, std::runtime_error for a bad file.
std::vector<NamedMesh> studyMeshes(const StudyOptions& options);

/// main() of a study: reads the command line over the defaults `full` or, with --quick, `quick`, and runs it.
/// @return the exit code; 2, with one line on stderr, for bad arguments or a study that throws.
int runStudy(int argc, char** argv, const std::string& description, const StudyOptions& full, const StudyOptions& quick,
             const std::function<void(const StudyOptions&)>& study);

}  // namespace sdf_ccd::benchmark
