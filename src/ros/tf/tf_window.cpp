#include "ros/tf/tf_window.h"

#include <algorithm>

#include "common/infinity.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kNoPiece = std::numeric_limits<std::size_t>::max();

/// Index of the last of increasing times that is not later than `time`; 0 if all are.
std::size_t indexBefore(const std::vector<double>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  return after == times.begin() ? 0 : static_cast<std::size_t>(after - times.begin()) - 1;
}

}  // namespace

void TfWindow::begin(const ros::Time& origin, std::size_t steps, std::size_t frames) {
  origin_ = origin;
  steps_.resize(steps);
  frames_.resize(frames);
}

void TfWindow::setStep(std::size_t index, const StepSource& source, const TimePart& part) {
  Step& step = steps_[index];
  step.before = source.before;
  step.is_inverse = source.is_inverse;
  step.piece = kNoPiece;
  step.pose_time = step.start = kNaN;
  step.times.clear();
  step.poses.clear();
  step.resting_times.clear();
  const TfEdge& edge = *source.edge;
  const TfPoses& records = edge.records;
  const std::size_t first = edge.is_static ? records.size() - 1 : records.lastUpTo(part.from);
  for (std::size_t i = first; i < records.size(); ++i) {
    const bool is_last = i + 1 == records.size() || records[i].stamp >= part.until;
    const bool rests =
        i != first && !is_last && isSamePose(records[i - 1], records[i]) && isSamePose(records[i], records[i + 1]);
    const double time = edge.is_static ? 0.0 : secondsBetween(origin_, records[i].stamp);
    if (rests) {
      step.resting_times.push_back(time);
    } else {
      step.times.push_back(time);
      step.poses.push_back(records[i]);
    }
    if (is_last) break;
  }
}

void TfWindow::setFrame(std::size_t index, const FrameSource& source, const TimePart& part) {
  Frame& frame = frames_[index];
  frame.source = source;
  frame.problem.clear();
  frame.from = secondsBetween(origin_, part.from);
  frame.until = secondsBetween(origin_, part.until);
}

void TfWindow::addRecordedTimes(const std::vector<std::size_t>& frames, std::vector<double>& times,
                                std::vector<double>& recorded) {
  for (Step& step : steps_) step.listed_from = step.listed_until = kNaN;
  for (const std::size_t index : frames) {
    const Frame& frame = frames_[index];
    for (int i = frame.source.step; i >= 0; i = steps_[i].before) {
      Step& step = steps_[i];
      if (step.listed_from == frame.from && step.listed_until == frame.until) break;  // all before it too
      step.listed_from = frame.from;
      step.listed_until = frame.until;
      if (step.times.size() < 2) continue;
      const auto first = std::upper_bound(step.times.begin(), step.times.end(), frame.from);
      times.insert(times.end(), first, std::lower_bound(first, step.times.end(), frame.until));
      for (const std::vector<double>* known : {&step.times, &step.resting_times}) {
        const auto from = std::lower_bound(known->begin(), known->end(), frame.from);
        recorded.insert(recorded.end(), from, std::upper_bound(from, known->end(), frame.until));
      }
    }
  }
}

const TfInterpolation& TfWindow::pieceOf(Step& step, std::size_t piece) {
  if (step.piece != piece) {
    step.interpolation = TfInterpolation(step.poses[piece], step.poses[piece + 1]);
    step.piece = piece;
  }
  return step.interpolation;
}

Isometry3d TfWindow::edgePose(Step& step, double time) {
  const std::size_t i = indexBefore(step.times, time);
  if (i + 1 == step.times.size() || time <= step.times[i]) return step.poses[i].isometry();
  return pieceOf(step, i).at((time - step.times[i]) / (step.times[i + 1] - step.times[i]));
}

const Isometry3d& TfWindow::poseOf(Step& step, double time) {
  if (step.pose_time == time) return step.X_W;
  const Isometry3d X_PF = edgePose(step, time);
  const Isometry3d X = step.is_inverse ? X_PF.inverse() : X_PF;
  step.X_W = step.before < 0 ? X : poseOf(steps_[step.before], time) * X;
  step.pose_time = time;
  return step.X_W;
}

const Isometry3d& TfWindow::pose(std::size_t frame, double time) {
  static const Isometry3d kFixed = Isometry3d::Identity();
  const int step = frames_[frame].source.step;
  return step < 0 ? kFixed : poseOf(steps_[step], time);
}

const TfWindow::Step& TfWindow::boundsOf(Step& step, double start, double end) {
  if (step.start == start && step.end == end) return step;
  const std::size_t i = indexBefore(step.times, start);
  double reach = step.poses[i].translation.norm();
  DerivativeBounds angle, slide;
  bool is_bounded = true;
  if (i + 1 < step.times.size() && end > step.times[i]) {
    const TfPose &a = step.poses[i], &b = step.poses[i + 1];
    is_bounded = start >= step.times[i] && end <= step.times[i + 1];
    if (!isSamePose(a, b)) {
      const double share = (end - start) / (step.times[i + 1] - step.times[i]);
      reach = std::max(reach, b.translation.norm());
      angle.first = share * pieceOf(step, i).angle();
      slide.first = share * (b.translation - a.translation).norm();
    }
  }
  CarriedDerivatives before;
  if (step.before >= 0) {
    const Step& known = boundsOf(steps_[step.before], start, end);
    before = known.carries;
    is_bounded &= known.is_bounded;
  }
  step.carries = step.is_inverse ? before.carryingInverse(reach, angle, slide) : before.carrying(reach, angle, slide);
  step.is_bounded = is_bounded;
  step.start = start;
  step.end = end;
  return step;
}

DerivativeSeries TfWindow::derivatives(std::size_t frame, double distance, double start, double end) {
  const int index = frames_[frame].source.step;
  if (index < 0) return {distance};
  const Step& step = boundsOf(steps_[index], start, end);
  return step.is_bounded ? step.carries.of(distance) : DerivativeSeries{kInfinity, kInfinity, kInfinity, kInfinity};
}

}  // namespace sdf_ccd
