#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "monitor/map/voxel_objects.h"
#include "ros/tf/tf_history.h"
#include "ros/world/describe_scene.h"
#include "ros/world/map_age.h"
#include "ros/world/message_object.h"
#include "ros/world/request_files.h"
#include "ros/world/rule_index.h"

namespace sdf_ccd {

/// Resources for changes of the scene.
struct ChangeSources {
  const TfHistory& history;
  const RequestFiles& files;
  RequestLimits limits;
  std::size_t triangles = RequestLimits().triangles;  ///< number that the call may still contain
  std::vector<std::string> warnings;                  ///< receives notes for the caller
  ros::Time now = {};                                 ///< of the call
};

/// The objects of the world and the rules about pairs, as update_scene changes them (SceneChange.msg). A copy costs
/// little compared with a change: a call changes a copy, so that either all of its changes take effect or none. Several
/// threads may copy one that none of them uses otherwise.
class ChangingScene {
 public:
  /// @param first  description of the scene that was built at start-up.
  ChangingScene(const DescribedScene& described, const PairRules& rules, const SceneDescription& first,
                const RequestPermissions& permissions = {});

  /// @throws std::exception with the reason, also if it is not permitted; this object must then be discarded.
  void apply(const SceneChange& change, ChangeSources& sources);

  /// Adds a body of the world as an object, or replaces the object of its name.
  void set(BodyDescription body);

  /// Replaces the tiles of the live map.
  /// @param objects  as which some of them are judged.
  /// @param age      of the map; null if it never gets too old.
  void setTiles(std::vector<BodyDescription> tiles, TileObjects objects, std::shared_ptr<MapAge> age) {
    tiles_ = std::make_shared<const std::vector<BodyDescription>>(std::move(tiles));
    tile_objects_ = std::make_shared<const TileObjects>(std::move(objects));
    map_age_ = std::move(age);
  }

  /// Replaces them by those of another version of this scene.
  void setTilesOf(const ChangingScene& other) {
    tiles_ = other.tiles_;
    tile_objects_ = other.tile_objects_;
    map_age_ = other.map_age_;
  }

  /// Sets what is known of the forces of bodies that awaited them at start-up.
  void setForces(const std::vector<std::string>& bodies, Forces forces);

  /// The same by those of another version of this scene.
  void setForcesOf(const ChangingScene& other) { forces_ = other.forces_; }

  const std::shared_ptr<MapAge>& mapAge() const { return map_age_; }

  /// The complete scene, to be built. @throws std::length_error if it exceeds the limits.
  SceneDescription description(const RequestLimits& limits) const;

  std::vector<std::string> objects() const;

  /// What requests have taken from the checks, as a warning; empty if nothing. Touch_links that name links near the
  /// object's are not in it: every grasp has some.
  std::string weakened(const SceneDescription& description) const;

  /// Per attached object: since when it is where it is on its link.
  std::map<std::string, ros::Time> attachedSince() const;

  /// Per object: the number of the change that last said what or where it is; 0: start-up. To attach an object, or to
  /// detach it, where it is does not count.
  std::map<std::string, std::uint64_t> declared() const;

  /// The world's objects in MoveIt's .scene format, in the fixed frame. Maps, which it cannot hold, are left out with a
  /// warning.
  /// @throws std::exception if tf does not know an object's pose, or an object's name cannot be saved.
  std::string text(const ChangeSources& sources, std::vector<std::string>& warnings) const;

 private:
  struct Object {
    BodyDescription body;
    std::string link;  // link that it is attached to; empty if there is none
    ros::Time attached_since;
    std::vector<std::string> touch_links;
    std::size_t order = 0;      // rank in the order in which objects were added
    bool is_unchanged = false;  // since start-up
    std::uint64_t declared = 0;
  };
  struct StartUp;   // data that does not change: the links, and the pairs that were left out at start-up
  struct Settled {  // what the rules say of links and objects: no map has to wait until that is found out again
    std::vector<PairDecision> allowed;
    std::shared_ptr<const RuleIndex::Known> matches;
  };

  void add(const SceneChange& change, ChangeSources& sources);
  void append(const SceneChange& change, ChangeSources& sources);
  void move(const SceneChange& change);
  void erase(const SceneChange& change);
  void attach(const SceneChange& change, ChangeSources& sources);
  void detach(const SceneChange& change, ChangeSources& sources);
  void addRule(const SceneChange& change, ChangeSources& sources);
  template <class Visit>
  bool anyNamed(const std::string& pattern, const Visit& visit) const;
  void requireNoneProtected(const std::string& pattern, const std::string& what) const;
  void load(const SceneChange& change, ChangeSources& sources);
  void requireReplaceable(const std::string& name, const std::string& what) const;
  void requireAddable(const std::string& name, const std::string& what) const;
  void requireRemovable(const SceneChange& change) const;

  BodyDescription make(const SceneChange& change, ChangeSources& sources) const;
  std::string frameOf(const SceneChange& change, const std::string& fallback) const;
  void requireUsableName(const std::string& name) const;
  Object& find(const std::string& name);
  RuleIndex ruleIndex() const;
  std::shared_ptr<const Settled> settle(const std::vector<BodyDescription>& bodies,
                                        const std::vector<const Object*>& objects) const;
  void leaveOut(const BodyDescription& body_a, const Object* a, const BodyDescription& body_b, const Object* b,
                RuleIndex& rules, std::vector<PairDecision>& allowed) const;
  bool mayTouch(const Object& object, const BodyDescription& other) const;
  bool hasChanged(const std::string& body) const;
  bool isJudgedAsObject(const BodyDescription& tile) const;
  bool isNoGrasp(const PairDecision& pair) const;
  void keepAllowed(RuleIndex& rules, std::vector<PairDecision>& allowed) const;

  std::shared_ptr<const StartUp> start_up_;
  std::map<std::string, Object> objects_;
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
