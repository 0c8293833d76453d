#pragma once

#include <utility>
#include <vector>

#include <urdf_model/model.h>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Pose of a joint's child link in the joint's frame, at a position [rad or m]. Planar and floating: identity.
Isometry3d jointMotion(const urdf::Joint& joint, double position);

/// RobotModel::positionAt(), of the child link's pose in the joint's frame.
double jointPosition(const urdf::Joint& joint, const Isometry3d& X_JC);

using Range = std::pair<double, double>;

/// Range of positions for reach bounds [m]: a prismatic joint's limits, in either order, extended on both sides by a
/// tenth of the range, at least 1 cm, because real joints overshoot and URDFs have errors. Two equal limits count as
/// none, because a URDF without limits reads like this. A mimic joint's range also covers its leader's.
Range reachRange(const urdf::ModelInterface& model, const urdf::Joint& joint);

/// Upper bound of the distance between the two ends of a chain of joints, over all joint positions.
///
/// The chain is cut at rotating joints. A piece between two cuts has a fixed length, or a range of lengths if a joint
/// in it translates; no more than the sum of all lengths is between the ends.
class ChainReach {
 public:
  /// @param start  the first end, in the frame that the first element is added to [m].
  explicit ChainReach(const Vector3d& start) { piece_.offset = -start; }

  void addFixed(const Isometry3d& X);
  /// @param forward  false if the chain passes from the joint's child to its parent.
  void addJoint(const urdf::Joint& joint, const Range& range, bool forward);

  /// To the other end, a point in the last frame [m].
  double farthest(const Vector3d& end) const;

 private:
  /// Vectors from the last cut to the frame's origin: offset + q slide, q in [low, high], in the frame's axes.
  struct Piece {
    Vector3d offset = Vector3d::Zero();
    Vector3d slide = Vector3d::Zero();
    double low = 0.0;
    double high = 0.0;
    Vector3d rotated_about = Vector3d::Zero();  ///< unit axis of the cut that it begins with; zero for the first piece

    bool slides() const { return !slide.isZero(0.0); }
    bool isPoint() const { return !slides() && offset.isZero(1e-15); }
  };
  /// A cut, and the piece that ends in it.
  struct Cut {
    Piece before;   ///< in the joint's axes
    Vector3d axis;  ///< unit, in the joint's axes
  };

  static double lengthOf(const Piece& piece);

  Piece piece_;
  std::vector<Cut> cuts_;
  std::vector<double> further_slides_;  ///< of pieces with more than one sliding joint: their greatest lengths [m]
  bool unlimited_ = false;
};

}  // namespace sdf_ccd
