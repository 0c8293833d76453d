#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "model/name_pair.h"
#include "ros/tf/tf_history.h"
#include "ros/world/describe_scene.h"
#include "ros/world/message_object.h"
#include "ros/world/request_files.h"

namespace sdf_ccd {

/// What changes of a scene are made with.
struct ChangeSources {
  const TfHistory& history;
  const RequestFiles& files;
  RequestLimits limits;
  std::size_t triangles = RequestLimits().triangles;  ///< that the call may still hold
  std::vector<std::string> warnings;                  ///< gets what is to be known
};

/// The objects of the world and what calls have said of pairs, as update_scene changes them (SceneChange.msg). A copy
/// is cheap beside what a change costs, so that a call changes a copy, and all or none of its changes count.
class ChangingScene {
 public:
  /// @param first  the scene that was built at start-up.
  ChangingScene(const DescribedScene& described, const PairRules& rules, const SceneDescription& first);

  /// @throws std::exception with the reason; then this is to be thrown away.
  void apply(const SceneChange& change, ChangeSources& sources);

  /// Sets an object, or replaces it, by a body of the world.
  void set(BodyDescription body);

  /// The tiles of a live map, in the place of those before.
  void setTiles(std::vector<BodyDescription> tiles) {
    tiles_ = std::make_shared<const std::vector<BodyDescription>>(std::move(tiles));
  }

  /// All of it, to be built. @throws std::length_error if that is more than may be.
  SceneDescription description(const RequestLimits& limits) const;

  /// The pairs that were left out at start-up as out of reach and still are, with their bodies' places in a
  /// description().
  std::vector<UnreachablePair> unreachable(const SceneDescription& description) const;

  std::vector<std::string> objects() const;

  /// The world's objects as MoveIt's .scene has them, in the fixed frame.
  /// @throws std::runtime_error if tf does not know where one is, or one has no such text (a map).
  std::string text(const ChangeSources& sources, std::vector<std::string>& warnings) const;

 private:
  struct Object {
    BodyDescription body;
    std::string link;  // that it is attached to; empty if it is not
    std::vector<std::string> touch_links;
    std::size_t since = 0;      // the order in which objects came
    bool is_as_first = false;   // as at start-up
  };
  struct Rule {
    PairRule pair;
    bool is_allowed;
  };
  struct Fixed;  // what does not change: the links, and what start-up said

  void add(const SceneChange& change, ChangeSources& sources);
  void move(const SceneChange& change);
  void erase(const SceneChange& change);
  void attach(const SceneChange& change, ChangeSources& sources);
  void detach(const SceneChange& change, ChangeSources& sources);
  void addRule(const SceneChange& change, const RequestLimits& limits);
  void load(const SceneChange& change, ChangeSources& sources);

  BodyDescription make(const SceneChange& change, ChangeSources& sources) const;
  std::string frameOf(const SceneChange& change, const std::string& otherwise) const;
  void requireFree(const std::string& name) const;
  Object& find(const std::string& name);
  const Rule* lastRule(const std::string& a, const std::string& b) const;
  std::string whyLeftOut(const Object& object, const BodyDescription& other, bool& proved) const;

  std::shared_ptr<const Fixed> fixed_;
  std::map<std::string, Object> objects_;
  std::shared_ptr<const std::vector<BodyDescription>> tiles_;
  std::vector<Rule> rules_;
  std::size_t count_ = 0;
};

}  // namespace sdf_ccd
