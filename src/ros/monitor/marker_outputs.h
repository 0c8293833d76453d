#pragma once

#include <atomic>
#include <memory>
#include <string>

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "ros/messages/link_markers.h"
#include "ros/messages/markers.h"
#include "ros/monitor/cycle_snapshot.h"
#include "ros/monitor/ordered_worker.h"

namespace sdf_ccd {

/// Draws what rviz shows, in a thread of its own.
///
/// Publishes, below the node's name:
///   markers  visualization_msgs/MarkerArray  contacts and status
///   links    visualization_msgs/MarkerArray  the links' collision shapes in the colours of their verdicts, all of them
///                                            when one changes; latched
///   world    visualization_msgs/MarkerArray  the world's objects as they are checked, again after changes, at most
///                                            once a second; latched
/// Nothing is drawn that has no subscriber. While drawing takes longer than cycles do, some cycles are not drawn: what
/// counts is the newest picture, and cycles never wait for one.
class MarkerOutputs {
 public:
  /// @param world  publisher of the world's objects.
  MarkerOutputs(ros::NodeHandle private_node, const ros::Publisher& world, const MonitorLoop& loop,
                const MarkerOptions& options);
  ~MarkerOutputs();

  /// Sets how markers are drawn from now on.
  void setOptions(const MarkerOptions& options) { options_ = options; }

  /// Draws the world again, for example after a jump of time, when rviz deletes all markers.
  void drawWorldAgain() { world_drawn_ = 0; }

  /// To be called now and then, as searching all topics of the process takes a while.
  void countSubscribers();

  bool wantsMarkers() const { return wants_markers_; }
  bool wantsLinks() const { return wants_links_; }

  /// Draws the loop's last cycle, which must have been requested with contacts and the clearances of all pairs.
  void draw();

  /// Removes the markers of contacts, as nothing is checked for this reason.
  void drawUnchecked(const std::string& reason);

  /// Draws no more cycles, but still shows that nothing is checked. Must be the last call.
  void finish();

 private:
  struct Drawing {
    bool is_unchecked = false;  // before the cycle
    std::string reason;         // of is_unchecked
    bool has_cycle = false;
    CycleSnapshot snapshot;  // of has_cycle
    bool draws_markers = false, draws_links = false, draws_world = false;
    MarkerOptions options;
    std::shared_ptr<const CheckedWorld> world;
  };

  Drawing* next(bool has_cycle);
  bool isWorldDue() const;
  void send(Drawing& drawing);
  void draw(const Drawing& drawing);
  void drawWorld(const CheckedWorld& world);
  void drawLinks();
  void setDrawnWorld(const std::shared_ptr<const CheckedWorld>& world);

  const MonitorLoop& loop_;
  ros::Publisher markers_, links_, world_publisher_;
  MarkerOptions options_;
  bool wants_markers_ = false, wants_links_ = false, wants_world_ = false;
  bool is_unchecked_ = false;      // since the last drawing that was handed over
  std::string reason_;             // of is_unchecked_
  std::uint64_t world_drawn_ = 0;  // version that was drawn last
  ros::WallTime world_drawn_at_;

  // Used by the drawing thread.
  std::shared_ptr<const CheckedWorld> drawn_;
  MarkerDrawer drawer_;
  std::unique_ptr<LinkMarkers> link_markers_;
  ros::WallTime links_drawn_at_;
  bool has_drawn_world_ = false;

  std::atomic<bool> is_finishing_{false};
  std::unique_ptr<OrderedWorker<Drawing>> worker_;
};

}  // namespace sdf_ccd
