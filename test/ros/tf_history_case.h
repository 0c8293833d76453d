#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ros/tf/tf_history.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::test {

inline std::string problemOf(const TfHistory& history, const std::string& frame, double time) {
  Isometry3d X_WF;
  std::string problem;
  history.lookup(frame, ros::Time(time), X_WF, problem);
  return problem;
}

inline double xOf(const TfHistory& history, const std::string& frame, double time) {
  Isometry3d X_WF;
  std::string problem;
  EXPECT_TRUE(history.lookup(frame, ros::Time(time), X_WF, problem)) << problem;
  return X_WF.translation().x();
}

inline std::vector<double> recordedTimes(const TfHistory& history, const std::string& frame, double from,
                                         double until) {
  TfWindow window;
  TfChains chains({frame});
  history.copy(chains, {{ros::Time(from), ros::Time(until)}}, ros::Time(from), window);
  std::vector<double> times, recorded;
  window.addRecordedTimes({0}, times, recorded);
  return times;
}

inline std::vector<TfSpan> takeSpans(TfHistory& history, const std::vector<std::string>& frames) {
  TfChains chains(frames);
  std::vector<TfSpan> spans;
  history.takeSpans(chains, spans);
  return spans;
}

}  // namespace sdf_ccd::test
