#include "contact_times.h"

#include <algorithm>
#include <vector>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

constexpr int kParts = 4;              // of a gap, at whose ends the bodies are looked at
constexpr double kShortestGap = 1e-9;  // of the span; shorter gaps are none

class TimeSearch {
 public:
  TimeSearch(SurfacePair& surfaces, const PairDepth& depth, double certain, SeparationMemory& memory,
             std::vector<TimeSample>& samples, PairResult& result)
      : surfaces_(surfaces),
        depth_(depth),
        certain_(certain),
        memory_(memory),
        samples_(samples),
        result_(result),
        start_(surfaces.motion().startTime()),
        end_(surfaces.motion().endTime()) {}

  void run(const PairDepth::Found& found, const std::optional<ContactPoint>& crossing) {
    if ((crossing && crossing->enter < crossing->exit) || found.throughout > certain_) {
      result_.intervals.push_back({start_, end_});
      result_.first_touch = {start_, start_};
      result_.last_touch = {end_, end_};
      return;
    }
    std::vector<TimeSample>& samples = samples_;
    lookAtSteps(samples);
    if (crossing) samples.push_back({crossing->time, true});
    if (found.deepest.depth > certain_) samples.push_back({found.deepest.time, true});
    sort(samples);
    addCrossings(samples);
    lookIntoGaps(samples);
    const auto touches = [](const TimeSample& sample) { return sample.touches; };
    if (std::none_of(samples.begin(), samples.end(), touches)) return setUncertain(found.deepest.time);
    for (auto from = samples.begin(); (from = std::find_if(from, samples.end(), touches)) != samples.end();) {
      const auto after = std::find_if_not(from, samples.end(), touches);
      const bool is_last = std::none_of(after, samples.end(), touches);
      setInterval(from == samples.begin()     ? nullptr
                  : result_.intervals.empty() ? &samples.front()
                                              : &*(from - 1),
                  {from->time, (after - 1)->time},
                  after == samples.end() ? nullptr
                  : is_last              ? &samples.back()
                                         : &*after);
      from = after;
    }
  }

 private:
  TimeSample at(double time) const {
    return {time, depth_.depthAt(time) > certain_ || surfaces_.crossingAt(time, result_.error.chord, memory_)};
  }

  static void sort(std::vector<TimeSample>& samples) {
    std::sort(samples.begin(), samples.end(), [](const TimeSample& a, const TimeSample& b) {
      return a.time != b.time ? a.time < b.time : a.touches > b.touches;
    });
    const auto isSame = [](const TimeSample& a, const TimeSample& b) { return a.time == b.time; };
    samples.erase(std::unique(samples.begin(), samples.end(), isSame), samples.end());
  }

  /// The ends of steps, at most some dozens.
  void lookAtSteps(std::vector<TimeSample>& samples) const {
    constexpr std::size_t kMost = 64;
    const RelativeMotion& motion = surfaces_.motion();
    samples.assign({at(start_), at(end_)});
    const std::size_t stride = (motion.steps() - 1) / kMost + 1;
    for (std::size_t step = stride; step < motion.steps(); step += stride)
      samples.push_back(at(motion.motion(step).t_start));
  }

  /// The crossings nearest to the times at which they are not known to touch.
  void addCrossings(std::vector<TimeSample>& samples) const {
    const auto add = [&](double from, double to) {
      const auto touch = between(from, to);
      if (touch && touch->crossing) samples.push_back({*touch->crossing, true});
    };
    for (std::size_t i = samples.size() - 1; i > 0; --i) {
      const TimeSample from = samples[i - 1], to = samples[i];
      if (!from.touches) add(from.time, to.time);
      if (!to.touches) add(to.time, from.time);
    }
    sort(samples);
  }

  /// Between two times at which they touch.
  void lookIntoGaps(std::vector<TimeSample>& samples) const {
    constexpr std::size_t kFew = 16;
    const int parts = samples.size() < kFew ? kParts : 2;
    for (std::size_t i = samples.size() - 1; i > 0; --i) {
      const TimeSample from = samples[i - 1], to = samples[i];
      if (!from.touches || !to.touches || to.time - from.time < kShortestGap * (end_ - start_)) continue;
      for (int k = 1; k < parts; ++k) samples.push_back(at(from.time + (to.time - from.time) * k / parts));
    }
    sort(samples);
  }

  std::optional<SurfacePair::Touch> between(double from, double to) const {
    return surfaces_.touch(from, to, result_.error.chord, memory_);
  }

  /// @param before, after  where they are not known to touch, nearest to the contact or, of the first and last one, at
  ///                       the ends of the motion; null if the contact reaches these ends.
  void setInterval(const TimeSample* before, Interval contact, const TimeSample* after) {
    Interval begin{contact.enter, contact.enter}, end{contact.exit, contact.exit};
    if (before) {
      const auto touch = between(before->time, contact.enter);
      if (touch) begin = {touch->apart, touch->crossing.value_or(contact.enter)};
    }
    if (after) {
      const auto touch = between(after->time, contact.exit);
      if (touch) end = {touch->crossing.value_or(contact.exit), touch->apart};
    }
    // Bodies may be inside each other where their surfaces are apart.
    if (result_.intervals.empty() && (!before || areApart(start_))) result_.first_touch = begin;
    result_.last_touch.reset();
    if (!after || areApart(end_)) result_.last_touch = end;
    result_.intervals.push_back({begin.enter, end.exit});
  }

  /// Nothing is certain, but the surfaces come close.
  void setUncertain(double deepest) {
    const auto first = between(start_, end_), last = between(end_, start_);
    result_.first_touch = {first ? first->apart : start_, kInfinity};
    result_.last_touch = {-kInfinity, last ? last->apart : end_};
    result_.intervals.push_back(
        {std::min(deepest, result_.first_touch->enter), std::max(deepest, result_.last_touch->exit)});
  }

  /// Whether the bodies are apart at the start or the end, where their surfaces are.
  bool areApart(double time) const {
    const RelativeMotion& motion = surfaces_.motion();
    return surfaces_.containment(time == start_ ? motion.start() : motion.end()).excluded;
  }

  SurfacePair& surfaces_;
  const PairDepth& depth_;
  const double certain_;
  SeparationMemory& memory_;
  std::vector<TimeSample>& samples_;
  PairResult& result_;
  const double start_, end_;
};

}  // namespace

void setContactTimes(SurfacePair& surfaces, const PairDepth& depth, const PairDepth::Found& found,
                     const std::optional<ContactPoint>& crossing, SeparationMemory& memory,
                     std::vector<TimeSample>& samples, PairResult& result) {
  TimeSearch(surfaces, depth, found.certain, memory, samples, result).run(found, crossing);
}

}  // namespace sdf_ccd
