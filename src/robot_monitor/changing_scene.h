#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "monitor/map/voxel_objects.h"
#include "robot_monitor/map_age.h"
#include "robot_monitor/request_permissions.h"
#include "robot_monitor/rule_index.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// What does not change after start-up: the links, and what start-up left out.
struct StartUpScene {
  std::shared_ptr<const RobotModel> robot;
  std::string link_prefix;  ///< of the links' frames
  std::string tiles_begin;  ///< prefix of the names of a live map's tiles; empty: there is no live map
  PairRules rules;
  RequestPermissions permissions;
  SceneDescription scene;  ///< that was built
};

/// An object of the world, or one that is attached to a link.
struct ChangingObject {
  BodyDescription body;
  std::string link;                              ///< that it is attached to; empty if there is none
  std::chrono::nanoseconds attached_since = {};  ///< since the epoch
  std::vector<std::string> touch_links;
  std::size_t order = 0;       ///< rank in the order in which objects were added
  bool is_unchanged = false;   ///< since start-up
  std::uint64_t declared = 0;  ///< number of the change that last said what or where it is; 0: start-up. To attach an
                               ///< object, or to detach it, where it is does not count
};

/// Where an object is attached.
struct Attachment {
  std::string link;
  Isometry3d X_LB = Isometry3d::Identity();  ///< of the object on the link
  std::vector<std::string> touch_links;
  std::chrono::nanoseconds since = {};  ///< the epoch: when it came there, if it is not there yet
};

/// The objects of the world and the rules about pairs, as requests change them. A copy costs little compared with a
/// change: a request changes a copy, so that either all of its changes take effect or none. Several threads may copy
/// one that none of them uses otherwise.
///
/// What changes it throws std::invalid_argument with the reason, and so do permissions: attach() and detach() need
/// those for the kind of the request before. `what` names the request's operation.
class ChangingScene {
 public:
  using Objects = std::map<std::string, ChangingObject>;

  explicit ChangingScene(StartUpScene start_up);

  const Objects& objects() const { return objects_; }
  const RobotModel& robot() const { return *start_up_->robot; }
  std::string frameOf(const std::string& link) const { return start_up_->link_prefix + link; }

  const RequestPermissions& permissions() const { return start_up_->permissions; }

  /// @throws std::invalid_argument if there is none.
  const ChangingObject& object(const std::string& name) const;

  /// Throws unless an object of the name may be added, or replaced if there is one.
  void requireAddable(const std::string& name, const std::string& what) const;

  /// Throws unless the object may be moved or extended.
  void requireReplaceable(const std::string& name, const std::string& what) const;

  /// Adds an object, or replaces the one of its name.
  void add(BodyDescription body);

  /// The object gets shapes, and stays where it is, attached or not.
  void append(const std::string& name, std::vector<GeometryDescription> parts, std::chrono::nanoseconds now);

  /// @param frame  empty: the present one.
  void move(const std::string& name, const std::string& frame, const Isometry3d& X_frame_B);

  /// @param pattern  of names.
  void remove(const std::string& pattern);

  void attach(const std::string& name, const Attachment& to, const RequestLimits& limits);

  /// @param frame, X_frame_B  where it is, and stays.
  void detach(const std::string& name, const std::string& frame, const Isometry3d& X_frame_B);

  /// @param warnings  gets a line for each pattern that names no body yet.
  void addRule(const RequestRule& rule, const RequestLimits& limits, std::vector<std::string>& warnings);
  void forgetRules();

  /// Replaces the tiles of the live map.
  /// @param objects  as which some of them are judged.
  /// @param age      of the map; null if it never gets too old.
  void setTiles(std::vector<BodyDescription> tiles, TileObjects objects, std::shared_ptr<MapAge> age);

  /// Replaces them by those of another version of this scene.
  void setTilesOf(const ChangingScene& other);

  /// Sets what is known of the forces of bodies that awaited them at start-up.
  void setForces(const std::vector<std::string>& bodies, Forces forces);

  /// The same by those of another version of this scene.
  void setForcesOf(const ChangingScene& other) { forces_ = other.forces_; }

  const std::shared_ptr<MapAge>& mapAge() const { return map_age_; }

  /// The complete scene, to be built. @throws std::length_error if it exceeds the limits.
  SceneDescription description(const RequestLimits& limits) const;

  /// What requests have taken from the checks, as a warning; empty if nothing. Touch_links that name links near the
  /// object's are not in it: every grasp has some.
  std::string weakened(const SceneDescription& description) const;

 private:
  struct Settled {  // what the rules say of links and objects: no map has to wait until that is found out again
    std::vector<PairDecision> allowed;
    std::shared_ptr<const RuleIndex::Known> matches;
  };

  ChangingObject& find(const std::string& name);
  template <class Visit>
  bool anyNamed(const std::string& pattern, const Visit& visit) const;
  void requireNoneProtected(const std::string& pattern, const std::string& what) const;
  RuleIndex ruleIndex() const;
  std::shared_ptr<const Settled> settle(const std::vector<BodyDescription>& bodies,
                                        const std::vector<const ChangingObject*>& objects) const;
  void leaveOut(const BodyDescription& body_a, const ChangingObject* a, const BodyDescription& body_b,
                const ChangingObject* b, RuleIndex& rules, std::vector<PairDecision>& allowed) const;
  bool mayTouch(const ChangingObject& object, const BodyDescription& other) const;
  bool hasChanged(const std::string& body) const;
  bool isJudgedAsObject(const BodyDescription& tile) const;
  bool isNoGrasp(const PairDecision& pair) const;
  void keepAllowed(RuleIndex& rules, std::vector<PairDecision>& allowed) const;

  std::shared_ptr<const StartUpScene> start_up_;  // without objects
  std::vector<std::string> first_objects_;        // names at start-up
  Objects objects_;
  std::shared_ptr<const std::vector<BodyDescription>> tiles_;
  std::shared_ptr<const TileObjects> tile_objects_;  // null if there are no tiles
  std::shared_ptr<MapAge> map_age_;
  std::map<std::string, Forces> forces_;  // of bodies that awaited them at start-up
  std::vector<RequestRule> rules_;
  mutable std::shared_ptr<const Settled> settled_;  // null after a change, until description()
  std::size_t added_ = 0;                           // number of objects ever added
  std::uint64_t declared_ = 0;                      // number of changes that said what or where an object is
};

}  // namespace sdf_ccd
