#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scene/pair_rules.h"
#include "sdf_ccd/distances.h"
#include "sdf_ccd/robot.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// How near pairs may come, by patterns of their bodies' names. Of several that match a pair, the last counts.
struct PairLimit {
  PairRule bodies;
  std::optional<double> stop_distance = {};  ///< [m]
};

/// Finds what the pairs of a robot's scene can do.
class RobotPairTraits {
 public:
  /// The link that carries a frame, by its index in RobotModel::links(); −1: none.
  using LinkOfFrame = std::function<int(const std::string& frame)>;

  /// @param robot  null: nothing is known of what joins the bodies.
  RobotPairTraits(std::shared_ptr<const RobotModel> robot, LinkOfFrame link_of_frame, std::vector<PairLimit> limits);

  /// @param scene        the bodies, in the order of `description`; those of the robot are in its links' frames.
  /// @param description  with the geometry of the bodies.
  std::vector<PairTraits> of(const Scene& scene, const SceneDescription& description);

 private:
  /// Kept from scene to scene, as a map changes them often: of a pair of links by name, with the balls it holds for.
  struct Known {
    BoundingBall ball_a, ball_b;
    double speed;
  };
  using KnownSpeeds = std::map<std::pair<std::string, std::string>, Known>;

  bool isConstant(const SceneDescription& description, const Scene& scene, const PlannedPair& pair) const;
  int linkOf(const Body& body) const { return robot_ ? link_of_frame_(body.frame) : -1; }
  double maxClosing(const Body& a, const Body& b, KnownSpeeds& next) const;

  std::shared_ptr<const RobotModel> robot_;
  std::vector<Isometry3d> X_RL_;  // of the links at rest
  LinkOfFrame link_of_frame_;
  std::vector<PairLimit> limits_;
  KnownSpeeds speeds_;  // of the last scene
};

}  // namespace sdf_ccd
