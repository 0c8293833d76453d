#pragma once

#include <map>
#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include "oracle/convex.h"
#include "oracle/least_value.h"

/// Exact motion of bodies between the stamps of transforms: each joint rotates at a constant rate and translates
/// linearly (tf2's slerp and lerp), computed in long double and without tf2.
namespace sdf_ccd::test {

class TfTruth {
 public:
  /// Adds an arriving transform. A static transform is valid after the last moving transform of its frame.
  void add(const geometry_msgs::TransformStamped& transform, bool is_static);

  /// Removes all but static transforms, after a jump back in time.
  void forgetMoving();

  /// A body attached to a frame.
  struct Carried {
    std::string frame;
    const Pieces* pieces;
  };

  /// Minimum separation of two bodies over the known parts of [from, to] [m]; low and high are infinite if there are
  /// none.
  LeastValue least(const Carried& a, const Carried& b, const ros::Time& from, const ros::Time& to,
                   const LeastOptions& options) const;

  /// The time `at` of a LeastValue counts seconds from this time.
  static constexpr double kEpoch = 1000.0;

  /// Separation, with its axis from A to B, at such a time.
  Separation at(const Carried& a, const Carried& b, Real time) const;

 private:
  struct Sample {
    Real time;
    LongPose X;
  };
  struct Edge {
    std::string parent;
    std::vector<Sample> samples;  // by time
    bool is_static = false;       // valid after the last sample
    LongPose rest;
  };
  /// A joint between two successive transforms.
  struct Joint {
    Real start, length;
    LongPose X;
    Vector3l turn, shift;  // rotation vector and translation over the length

    LongPose pose(Real time) const;
  };
  using Chain = std::vector<Joint>;  // beginning at the root

  std::vector<const Edge*> edges(const std::string& frame) const;
  bool chain(const std::string& frame, Real middle, Chain& joints) const;
  static LongPose pose(const Chain& chain, Real time);
  static Real speed(const Chain& chain, const Pieces& pieces);

  std::map<std::string, Edge> edges_;  // by child
};

}  // namespace sdf_ccd::test
