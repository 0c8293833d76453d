#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <geometry_msgs/WrenchStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "ros/messages/message_pool.h"
#include "ros/monitor/marker_outputs.h"
#include "ros/monitor/ordered_worker.h"
#include "ros/monitor/proximity_outputs.h"
#include "ros/monitor/torque_output.h"
#include "sdf_ccd/ContactArray.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

/// Publishes the results of a cycle.
///
/// Publishes, below the node's name, besides the topics of MarkerOutputs:
///   state            sdf_ccd/MonitorState         every cycle; without subscribers once a second and when the verdict
///                                                 or proximity has changed, so that the latched message holds numbers
///   contacts         sdf_ccd/ContactArray         every cycle, and once a second while there is none
///   contact_states   gazebo_msgs/ContactsState    every cycle; see toContactStates()
///   wrenches/<link>  geometry_msgs/WrenchStamped  every cycle: sum of the contact wrenches on the link, in the link's
///                                                 frame, about its origin [N, N·m]
///   joint_torques    sensor_msgs/JointState       see TorqueOutput
/// The last two only once the forces of all pairs that they need are known (Forces).
/// Nothing is computed or filled that has no subscriber.
///
/// The thread of the cycles fills the messages, which takes no longer than to copy its results. Another thread
/// publishes them in their order, without a copy for subscribers in the same process: serialising and sending take no
/// time from the cycles, which are blocked only while the messages of several cycles wait. None of them is dropped.
class Outputs {
 public:
  /// @param state  publisher of the states given below.
  /// @param world  publisher of the world's objects.
  Outputs(const ros::NodeHandle& private_node, const ros::Publisher& state, const ros::Publisher& world,
          MonitorLoop& loop, const DescribedScene& described, const MarkerOptions& options,
          ProximityOutputs& proximity);

  ~Outputs();

  /// A topic, and its messages.
  struct WrenchTopic {
    ros::Publisher publisher;
    std::shared_ptr<MessagePool<geometry_msgs::WrenchStamped>> messages;
  };

  /// The wrenches on a link, or on an object attached to one.
  struct LinkWrench : WrenchTopic {
    int body;
    bool is_ready = true;  ///< the forces of all of its pairs are known
    bool is_wanted = false;
  };

  /// The publishers for another world; after adopt(), the former ones.
  struct Change {
    std::vector<LinkWrench> wrenches;
    std::vector<int> link_of_body;  ///< see TorqueOutput
    bool are_all_ready = true;
  };

  /// Makes the publishers for the links and attached objects of a world, and drops those that neither it nor the
  /// present one uses. Takes as long as the ROS master does: to be called before prepare(), by a thread for which
  /// nobody waits. One thread at a time.
  void advertise(const SceneDescription& next, const SceneDescription& present);

  /// The publishers for another world, as far as they are made; may run in parallel to cycles, but not to adopt().
  std::unique_ptr<Change> prepare(const CheckedWorld& next);

  /// Switches to the loop's world, between two cycles. Frees no memory.
  /// @param change  made by prepare() since the last adopt(); to be destroyed by a thread that has the time for it.
  void adopt(Change& change);

  MarkerOutputs& markers() { return markers_; }

  /// The request for the next cycle, according to the subscribers.
  CycleRequest request(int max_points);

  /// Whether anything that holds wrenches has ever had a subscriber. May be called from any thread.
  bool haveWantedWrenches() const { return have_wanted_wrenches_; }

  /// Publishes the loop's last cycle.
  /// @param state      of that cycle.
  /// @param distances  of that cycle, or null.
  void publish(const boost::shared_ptr<MonitorState>& state, const boost::shared_ptr<DistanceArray>& distances);

  /// Publishes that nothing is checked after the last cycle, for this reason: a message without pairs, and no markers.
  /// @param state  with the same content.
  void publishUnchecked(const std::string& reason, const boost::shared_ptr<MonitorState>& state);

  /// Publishes what still waits, but draws nothing. Must be the last call.
  void finish();

 private:
  using WrenchMessage = boost::shared_ptr<geometry_msgs::WrenchStamped>;

  struct Report {                              // about a cycle, or that there is none
    boost::shared_ptr<ContactArray> contacts;  // null if nobody listens
    bool has_contact_states = false;           // publish them, too
    boost::shared_ptr<MonitorState> state;
    boost::shared_ptr<DistanceArray> distances;
    boost::shared_ptr<sensor_msgs::JointState> torques;
    std::vector<std::pair<ros::Publisher, WrenchMessage>> wrenches;
  };

  void countSubscribers();
  bool isDue(const MonitorState& state);
  void send(Report& report);

  ros::NodeHandle node_;
  MonitorLoop& loop_;
  ProximityOutputs& proximity_;
  ros::Publisher state_, contacts_, contact_states_;
  std::mutex topics_mutex_;
  std::map<std::string, WrenchTopic> topics_;  // by name; guarded by topics_mutex_
  std::vector<LinkWrench> wrenches_;           // those of the cycles
  TorqueOutput torques_;
  MarkerOutputs markers_;
  MessagePool<ContactArray> contact_messages_;

  ros::WallTime counted_at_;                        // when subscribers were last counted
  ros::WallTime state_due_;                         // when a state is published without subscribers
  std::uint8_t verdict_ = 0, proximity_level_ = 0;  // of the state that was published last
  bool are_all_ready_ = true;                       // all wrenches
  std::atomic<bool> have_wanted_wrenches_{false};
  bool contact_states_wanted_ = false;
  bool contacts_wanted_ = false, state_wanted_ = false, wrenches_wanted_ = false, torques_wanted_ = false;

  std::unique_ptr<OrderedWorker<Report>> worker_;
};

}  // namespace sdf_ccd
