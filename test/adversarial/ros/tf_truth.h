#pragma once

#include <map>
#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include "oracle/convex.h"
#include "oracle/least_value.h"

/// What transforms say of the bodies between their stamps: each joint turns evenly and shifts straight (tf2's slerp and
/// lerp), in long double and without tf2.
namespace sdf_ccd::test {

class TfTruth {
 public:
  /// Takes over a transform as it arrives. What is static holds from the last moving transform of that frame on.
  void add(const geometry_msgs::TransformStamped& transform, bool is_static);

  /// Time has jumped back: only static transforms remain.
  void forgetMoving();

  /// A body that a frame carries.
  struct Carried {
    std::string frame;
    const Pieces* pieces;
  };

  /// Least separation of two bodies over what is known of [from, to] [m]; low and high are infinite if nothing is.
  LeastValue least(const Carried& a, const Carried& b, const ros::Time& from, const ros::Time& to,
                   const LeastOptions& options) const;

  /// Times `at` of LeastValue are seconds from this time on.
  static constexpr double kEpoch = 1000.0;

  /// Where it is, by the last of `least`: the axis from A to B.
  Separation at(const Carried& a, const Carried& b, Real time) const;

 private:
  struct Sample {
    Real time;
    LongPose X;
  };
  struct Edge {
    std::string parent;
    std::vector<Sample> samples;  // by time
    bool is_static = false;       // after the last sample
    LongPose rest;
  };
  /// One joint within a time in which none of its transforms is stamped.
  struct Joint {
    Real start, length;
    LongPose X;
    Vector3l turn, shift;  // over the length

    LongPose pose(Real time) const;
  };
  using Chain = std::vector<Joint>;  // from the root on

  std::vector<const Edge*> edges(const std::string& frame) const;
  bool chain(const std::string& frame, Real middle, Chain& joints) const;
  static LongPose pose(const Chain& chain, Real time);
  static Real speed(const Chain& chain, const Pieces& pieces);

  std::map<std::string, Edge> edges_;  // by child
};

}  // namespace sdf_ccd::test
