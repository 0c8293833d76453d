#pragma once

#include <memory>
#include <string>

#include "ros/describe_scene.h"
#include "ros/planned_motion.h"
#include "ros/tf_tracker.h"
#include "sdf_ccd/QueryMotion.h"
#include "sdf_ccd/QueryPoints.h"

namespace sdf_ccd {

/// Answers query_motion and query_points, beside the cycles: it has a monitor of its own. One call at a time.
class Queries {
 public:
  Queries(std::shared_ptr<const Scene> scene, const DescribedScene& described, const MonitorParameters& parameters,
          const TfHistory& history, const TfTracker& tracker);

  void answer(const QueryMotion::Request& request, QueryMotion::Response& response);
  void answer(const QueryPoints::Request& request, QueryPoints::Response& response) const;

 private:
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const RobotModel> robot_;
  std::string tf_prefix_, base_joint_;
  std::vector<UnreachablePair> unreachable_;
  MotionSampling sampling_;
  int max_points_;
  const TfHistory& history_;
  const TfTracker& tracker_;
  Monitor monitor_;
};

}  // namespace sdf_ccd
