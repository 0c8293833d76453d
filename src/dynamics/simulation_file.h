#pragma once

#include <string>

#include "dynamics/simulation.h"

namespace sdf_ccd {

/// A scene that is ready to run.
struct SimulationSetup {
  RigidWorld world;
  std::vector<BodyState> states;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;  ///< per body, frame B, to look at; null for a half-space
  std::vector<std::string> warnings;  ///< bodies whose meshes are not closed, so that what is inside them is doubtful
  Scheme scheme = Scheme::kImplicit;
  double step = 1e-3;     ///< [s]
  double duration = 1.0;  ///< [s]
};

/// Reads a scene in YAML, as the commented ones in config/scenes: integrator, step, duration, gravity, contact, shapes,
/// bodies. Fields and shells of bodies that share a shape are built once.
///
/// Poses are given in the frame `origin` (default the world's). If the first moving body is farther than 100 m from it,
/// the scene's frame O is put, by whole metres, near that body.
/// @param text       the file's content.
/// @param directory  mesh files are looked up from here.
/// @throws std::runtime_error naming line and key, or the body or shape, and the reason; also for a moving body of a
/// mesh that is not closed, unless mass and inertia are given.
SimulationSetup parseSimulation(const std::string& text, const std::string& directory);

/// The same from a file; errors begin with its name.
SimulationSetup loadSimulation(const std::string& path);

}  // namespace sdf_ccd
