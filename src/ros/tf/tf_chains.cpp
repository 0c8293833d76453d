#include "ros/tf/tf_chains.h"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

const TimePart kNever{ros::TIME_MAX, ros::Time()};
constexpr std::size_t kNamed = 8;  // frames of a loop that a message names

/// Describes a chain with more edges above a frame than allowed: "… a loop: hand in arm in base in hand".
std::string endlessText(const TfTree& tree, const std::string& frame, const std::vector<int>& edges) {
  const std::string text = "the transforms above " + frame + " are ";
  std::vector<int> loop;
  for (const int edge : edges) {
    const auto first = std::find(loop.begin(), loop.end(), edge);
    if (first == loop.end()) {
      loop.push_back(edge);
      continue;
    }
    loop.erase(loop.begin(), first);
    std::string names;
    for (std::size_t i = 0; i < std::min(kNamed, loop.size()); ++i) names.append(tree.name(loop[i])).append(" in ");
    if (loop.size() > kNamed) names += "others in ";
    return fmt::format("{}a loop: {}{}", text, names, tree.name(edge));
  }
  return text + "more than " + std::to_string(kMaxAbove);
}

}  // namespace

TfChains::TfChains(std::vector<std::string> frames) : frames_(std::move(frames)) {
  std::unordered_map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < frames_.size(); ++i) first_of_.push_back(first.emplace(frames_[i], i).first->second);
}

void TfChains::update(const TfTree& tree, int fixed_frame) {
  if (topology_ == tree.topology(depends_on_all_)) return;
  steps_.clear();
  steps_to_.assign(tree.size(), -1);
  chains_.resize(frames_.size());
  tree.upwards(fixed_frame, above_);
  depends_on_all_ = false;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (first_of_[i] == i) {
      findChain(tree, fixed_frame, frames_[i], chains_[i]);
    } else {
      chains_[i] = chains_[first_of_[i]];
    }
  }
  topology_ = tree.topology(depends_on_all_);
}

void TfChains::findChain(const TfTree& tree, int fixed_frame, const std::string& frame, Chain& chain) {
  const std::string& fixed_name = tree.name(fixed_frame);
  chain = {};
  const int number = tree.find(frame);
  depends_on_all_ |= number == TfTree::kNone || !tree.isFollowed(number) || !tree.isFollowed(fixed_frame);
  up_.clear();
  down_ = above_;
  if (number != TfTree::kNone) tree.upwards(number, up_);
  // As in tf2, what is above the fixed frame is of no concern to frames below it, also if it is a loop.
  const auto isBelowFixed = [&](int edge) { return tree.parent(edge) == fixed_frame; };
  const auto last = std::find_if(up_.begin(), up_.end(), isBelowFixed);
  if (number == fixed_frame || last != up_.end()) {
    up_.erase(number == fixed_frame ? up_.begin() : last + 1, up_.end());
    down_.clear();
  }
  if (up_.size() > kMaxAbove || down_.size() > kMaxAbove) {
    chain.problem = up_.size() > kMaxAbove ? endlessText(tree, frame, up_) : endlessText(tree, fixed_name, down_);
    return;
  }
  const int root = number == TfTree::kNone ? TfTree::kNone : tree.root(number, up_);
  const int fixed_root = tree.root(fixed_frame, down_);
  if (root != fixed_root) {
    chain.problem = "no transform from " + frame + " to " + fixed_name + ": ";
    if (up_.empty()) {
      chain.problem += "no transform of " + frame + " was received";
    } else if (down_.empty()) {
      chain.problem += "tf's tree is rooted at " + tree.name(root) + ", not " + fixed_name;
    } else {
      chain.problem +=
          "its tree is rooted at " + tree.name(root) + ", that of " + fixed_name + " at " + tree.name(fixed_root);
    }
    return;
  }
  while (!up_.empty() && !down_.empty() && up_.back() == down_.back()) {
    up_.pop_back();
    down_.pop_back();
  }
  for (const int edge : down_) chain.step = stepTo(tree.parent(edge), {edge, chain.step, true});
  for (auto edge = up_.rbegin(); edge != up_.rend(); ++edge) chain.step = stepTo(*edge, {*edge, chain.step, false});
}

/// Chains that lead to the same frame share their steps up to it.
int TfChains::stepTo(int frame, const Step& step) {
  int& known = steps_to_[frame];
  if (known < 0) {
    known = static_cast<int>(steps_.size());
    steps_.push_back(step);
  }
  return known;
}

void TfChains::spans(const TfTree& tree, bool any_late, std::vector<TfSpan>& spans) {
  step_spans_.resize(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    StepSpan span = steps_[i].before < 0 ? StepSpan() : step_spans_[steps_[i].before];
    const TfEdge& edge = tree.edge(steps_[i].edge);
    if (edge.version > span.version) {
      span.version = edge.version;
      span.changed = steps_[i].edge;
    }
    span.first = std::max(span.first, edge.first());
    if (!edge.is_static) {
      const ros::Time& last = edge.records.back().stamp;
      span.last = span.is_static ? last : std::min(span.last, last);
      span.is_static = false;
    }
    step_spans_[i] = span;
  }
  spans.resize(chains_.size());
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    const Chain& chain = chains_[i];
    StepSpan known = chain.step < 0 ? StepSpan() : step_spans_[chain.step];
    known.is_static &= chain.problem.empty();
    TfSpan& span = spans[i];
    span.problem = chain.problem;
    span.is_static = known.is_static;
    span.first = known.first;
    span.last = known.last;
    if (known.version > 0 && known.version != span.version) {
      span.change = tree.name(known.changed) + " " + tree.edge(known.changed).change;
    }
    span.version = known.version;
    span.late.clear();
    for (int step = any_late ? chain.step : -1; step >= 0; step = steps_[step].before) {
      const TfEdge& edge = tree.edge(steps_[step].edge);
      if (edge.late) span.late.push_back({tree.name(steps_[step].edge), edge.late->since, edge.late->until});
    }
  }
}

void TfChains::copy(const TfTree& tree, const std::vector<TimePart>& parts, const ros::Time& origin, TfWindow& window) {
  step_parts_.assign(steps_.size(), kNever);
  const auto extend = [&](int step, const TimePart& part) {
    TimePart& known = step_parts_[step];
    known = {std::min(known.from, part.from), std::max(known.until, part.until)};
  };
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    if (chains_[i].step >= 0) extend(chains_[i].step, parts[i]);
  }
  for (std::size_t i = steps_.size(); i-- > 0;) {
    if (steps_[i].before >= 0) extend(steps_[i].before, step_parts_[i]);
  }
  window.begin(origin, steps_.size(), chains_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    window.setStep(i, {&tree.edge(steps_[i].edge), steps_[i].before, steps_[i].is_inverse}, step_parts_[i]);
  }
  summaries_.assign(steps_.size(), {kNever});
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    const int step = chains_[i].step;
    const Summary known = step < 0 ? Summary() : summarise(tree, step, parts[i]);
    window.setFrame(i, {step, known.version, known.longest_gap, known.gaps}, parts[i]);
    if (!chains_[i].problem.empty()) {
      window.setProblem(i, chains_[i].problem);
    } else if (known.problem) {
      window.setProblem(i, tree.name(known.problem_edge) + " " + known.problem);
    }
  }
}

/// What is known of the chain up to a step over a part of the time; of several problems, the one nearest to the fixed
/// frame.
const TfChains::Summary& TfChains::summarise(const TfTree& tree, int step, const TimePart& part) {
  Summary& own = summaries_[step];
  if (own.part.from == part.from && own.part.until == part.until) return own;
  const int number = steps_[step].edge;
  const TfEdge& edge = tree.edge(number);
  const TfPoses& records = edge.records;
  own = {part, edge.version};
  if (part.from < edge.first() || (!edge.is_static && records.back().stamp < part.until)) {
    own.problem = "is not known at all times";
  }
  for (std::size_t i = records.lastUpTo(part.from); i < records.size(); ++i) {
    if (records[i].problem) own.problem = records[i].problem;
    if (edge.is_static || records[i].stamp >= part.until || i + 1 == records.size()) break;
    own.longest_gap = std::max(own.longest_gap, secondsBetween(records[i].stamp, records[i + 1].stamp));
    if (own.moved.first.isZero()) own.moved.first = records[i].stamp;
    own.moved.last = records[i + 1].stamp;
  }
  own.gaps = own.moved.longest_gap = own.longest_gap;
  own.problem_edge = number;
  if (steps_[step].before < 0) return own;
  const Summary& before = summarise(tree, steps_[step].before, part);
  own.version = std::max(own.version, before.version);
  own.longest_gap = std::max(own.longest_gap, before.longest_gap);
  const bool moves = own.moved.longest_gap > 0.0;
  const bool is_stamped_alike = moves && own.moved.first == before.moved.first && own.moved.last == before.moved.last &&
                                own.moved.longest_gap == before.moved.longest_gap;
  own.gaps = before.gaps + (is_stamped_alike ? 0.0 : own.gaps);
  if (!moves) own.moved = before.moved;
  if (before.problem) {
    own.problem_edge = before.problem_edge;
    own.problem = before.problem;
  }
  return own;
}

}  // namespace sdf_ccd
