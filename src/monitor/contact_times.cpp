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
    Samples& samples = samples_;
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
      setInterval(from, after - 1, std::none_of(after, samples.end(), touches));
      from = after;
    }
  }

 private:
  using Samples = std::vector<TimeSample>;

  TimeSample at(double time) const {
    return {time, depth_.depthAt(time) > certain_ || surfaces_.crossingAt(time, result_.error.chord, memory_)};
  }

  static void sort(Samples& samples) {
    std::sort(samples.begin(), samples.end(), [](const TimeSample& a, const TimeSample& b) {
      return a.time != b.time ? a.time < b.time : a.touches > b.touches;
    });
    const auto isSame = [](const TimeSample& a, const TimeSample& b) { return a.time == b.time; };
    samples.erase(std::unique(samples.begin(), samples.end(), isSame), samples.end());
  }

  /// The ends of steps, at most some dozens.
  void lookAtSteps(Samples& samples) const {
    constexpr std::size_t kMost = 64;
    const RelativeMotion& motion = surfaces_.motion();
    samples.assign({at(start_), at(end_)});
    const std::size_t stride = (motion.steps() - 1) / kMost + 1;
    for (std::size_t step = stride; step < motion.steps(); step += stride)
      samples.push_back(at(motion.motion(step).t_start));
  }

  /// The crossings nearest to the times at which they are not known to touch.
  void addCrossings(Samples& samples) const {
    for (std::size_t i = samples.size() - 1; i > 0; --i) {
      const auto add = [&](std::optional<double> crossing) {
        if (crossing) samples.push_back({*crossing, true});
        return crossing;
      };
      double start = samples[i - 1].time;
      const double end = samples[i].time;
      if (!samples[i - 1].touches) {
        const std::optional<double> crossing = add(searchFrom(samples[i - 1], samples[i - 1].apart_until, end));
        if (samples[i - 1].apart_until == end) samples[i].apart_since = start;
        start = crossing.value_or(start);
      }
      if (!samples[i].touches && !samples[i].apart_since) add(searchFrom(samples[i], samples[i].apart_since, start));
    }
    sort(samples);
  }

  /// Between two times at which they touch.
  void lookIntoGaps(Samples& samples) const {
    constexpr std::size_t kFew = 16;
    const int parts = samples.size() < kFew ? kParts : 2;
    for (std::size_t i = samples.size() - 1; i > 0; --i) {
      const TimeSample from = samples[i - 1], to = samples[i];
      if (!from.touches || !to.touches || to.time - from.time < kShortestGap * (end_ - start_)) continue;
      for (int k = 1; k < parts; ++k) samples.push_back(at(from.time + (to.time - from.time) * k / parts));
    }
    sort(samples);
  }

  /// Searches from a time at which they are not known to touch, forward or backward.
  /// @param apart  receives the time up to which they are apart. @return the first crossing.
  std::optional<double> searchFrom(const TimeSample& sample, std::optional<double>& apart, double to) const {
    const auto touch = surfaces_.touch(sample.time, to, result_.error.chord, memory_);
    apart = touch ? touch->apart : to;
    return touch ? touch->crossing : std::nullopt;
  }

  /// The time up to which they are apart on the way from one sample to another.
  double apartUpTo(Samples::iterator from, Samples::iterator to) const {
    const int direction = from < to ? 1 : -1;
    for (; from != to; from += direction) {
      std::optional<double>& apart = direction > 0 ? from->apart_until : from->apart_since;
      const double next = (from + direction)->time;
      if (!apart) searchFrom(*from, apart, next);
      if (apart != next) return *apart;
    }
    return to->time;
  }

  /// @param first, last  samples between which they touch, with nothing else between them.
  void setInterval(Samples::iterator first, Samples::iterator last, bool is_last) {
    const auto start = samples_.begin(), end = samples_.end() - 1;
    const bool is_first = result_.intervals.empty();
    const double enter = first == start ? start_ : apartUpTo(is_first ? start : first - 1, first);
    const double exit = last == end ? end_ : apartUpTo(is_last ? end : last + 1, last);
    // Bodies may be inside each other where their surfaces are apart.
    if (is_first && (first == start || areApart(start_))) result_.first_touch = {enter, first->time};
    if (is_last && (last == end || areApart(end_))) result_.last_touch = {last->time, exit};
    result_.intervals.push_back({enter, exit});
  }

  /// Nothing is certain, but the surfaces come close.
  void setUncertain(double deepest) {
    const auto first = samples_.begin(), last = samples_.end() - 1;
    const double enter = apartUpTo(first, last), exit = apartUpTo(last, first);
    result_.first_touch = {enter < end_ ? enter : start_, kInfinity};
    result_.last_touch = {-kInfinity, exit > start_ ? exit : end_};
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
  Samples& samples_;
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
