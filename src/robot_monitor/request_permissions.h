#pragma once

#include <string>
#include <vector>

#include "robot/world_shapes.h"

namespace sdf_ccd {

/// Limits of one request; more is refused.
struct RequestLimits {
  std::size_t name = 256;  ///< characters
  std::size_t objects = kMaxObjects;
  std::size_t shapes = 1000;        ///< of an object
  std::size_t triangles = 2000000;  ///< of a request
  std::size_t rules = 1000;         ///< made by requests, in total; and touch_links of an object
  std::size_t pairs = 300000;       ///< of a scene
};

/// @throws std::invalid_argument if the name is empty, too long or contains control characters; `what` describes it.
void requireName(const std::string& name, const std::string& what, const RequestLimits& limits);

/// What clients may change while the monitor runs: the parameters requests/allow and requests/protected. Every client
/// of the ROS master can call the services.
struct RequestPermissions {
  bool add = true;      ///< objects, under names that no object has
  bool move = true;     ///< objects, or replace their shapes, or add to them
  bool attach = true;   ///< objects, with touch_links; and detach them
  bool rules = true;    ///< ALLOW, CHECK, FORGET_RULES
  bool clear = true;    ///< remove objects
  bool reset = true;    ///< forget all contacts, once a second
  bool limits = false;  ///< dynamic_reconfigure: rate, distances and the robot's limits, to the unsafe side, too

  /// Patterns of bodies that requests can neither move, replace, extend, attach, detach, remove nor allow to touch.
  std::vector<std::string> protected_bodies;

  bool isProtected(const std::string& body) const;

  /// @throws std::invalid_argument that names the parameter, if the body is protected; `what` says what was requested.
  void requireUnprotected(const std::string& body, const std::string& what) const;
};

/// @param is_allowed  RequestPermissions::rules, for example.
/// @throws std::invalid_argument that names the parameter and the kind, if it is not.
void requireAllowed(bool is_allowed, const std::string& kind, const std::string& what);

/// The permissions of a list such as {"add", "move"}. @throws std::invalid_argument for an unknown kind.
RequestPermissions permissionsOf(const std::vector<std::string>& kinds);

}  // namespace sdf_ccd
