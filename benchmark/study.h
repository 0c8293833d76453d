#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "measure.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::benchmark {

/// The command line options of all studies; each study uses those that concern it.
struct StudyOptions {
  bool quick = false;
  std::vector<std::string> mesh_files;                        ///< NAME=FILE
  std::vector<std::string> meshes;                            ///< names; only those, all if empty
  std::vector<std::string> paper_meshes{"bunny3k", "torus"};  ///< meshes for which the paper's dense grids are built
  std::vector<std::string> robots;                            ///< NAME=URDF[,SRDF]
  std::string bag;                                            ///< with a robot's motion, for the study `anytime`
  std::string map;                                            ///< an OctoMap's file, for the study `map`
  std::string queries;                                        ///< folder of public queries, for the study `truth`
  std::vector<std::string> cases;                             ///< only those, all if empty
  std::vector<std::string> systems;                           ///< for the study `monitor`; all if empty
  std::vector<int> cells;                                     ///< uniform fields: cells along the longest side
  std::vector<std::string> errors;   ///< fields to a maximum error, in box sides; as text, it names the case
  std::size_t segments = 1'000'000;  ///< random segments per case
  long motions = 1'000'000;          ///< per family of the study `truth`
  int pairs = 1000;                  ///< random pose pairs per case
  int cycles = 10'000;               ///< of 1 ms each, per case of the study `monitor`
  std::string plots;                 ///< directory for a study's own plots; none if empty
  MeasureOptions measure;
};

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;  ///< oriented outward
};

/// Whether `wanted` holds the name or is empty.
bool isWanted(const std::vector<std::string>& wanted, const std::string& name);

/// The robots given on the command line; without any, this one.
inline std::vector<std::string> robotsOr(const StudyOptions& options, const std::string& otherwise) {
  return options.robots.empty() ? std::vector<std::string>{otherwise} : options.robots;
}

/// The chosen meshes among the given files; a generated torus and box if there are none.
/// @throws std::invalid_argument for a file argument of another form, std::runtime_error for a bad file.
std::vector<NamedMesh> studyMeshes(const StudyOptions& options);

/// main() of a study: parses the command line, with the defaults `full` or, with --quick, `quick`, and runs the study.
/// @return the exit code; 2, with one line on stderr, for bad arguments or a study that throws.
int runStudy(int argc, char** argv, const std::string& description, const StudyOptions& full, const StudyOptions& quick,
             const std::function<void(const StudyOptions&)>& study);

}  // namespace sdf_ccd::benchmark
