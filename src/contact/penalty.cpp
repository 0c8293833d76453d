#include "penalty.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "chord_frame.h"
#include "common/number_text.h"
#include "deepest.h"
#include "field/cell_reader.h"
#include "sdf_ccd/common/cancel.h"
#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd {
namespace {

struct Node {
  double s;
  double weight;
};

// Three-point Gauss on [0, 1]: exact up to degree 5, which d (cubic) times N and r (linear) is (design §3.9).
const std::vector<Node> kGauss = {
    {0.5 - std::sqrt(0.15), 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + std::sqrt(0.15), 5.0 / 18.0}};
const std::vector<Node> kMidpoint = {{0.5, 1.0}};

// Values of sibling fields that differ by less than this, the rounding of their poses, count as equal [m].
constexpr double kTie = 1e-9;

bool isRound(const DistanceField& field) {
  const Primitive* const primitive = field.primitive();
  return primitive && (std::holds_alternative<Sphere>(*primitive) || std::holds_alternative<Cylinder>(*primitive));
}

class Integrator {
 public:
  Integrator(const ContactInput& input, const ContactOptions& options, const ContactRequest& request,
             ContactImpulse& result)
      : input_(input),
        field_(input.field),
        is_round_(isRound(input.field)),
        options_(options),
        rule_(options.quadrature == Quadrature::kExact ? kGauss : kMidpoint),
        request_(request),
        result_(result) {}

  void add(const ShellHit& hit) {
    if (hit.chord != chord_) {
      chord_ = hit.chord;
      poses_.begin(ChordFrame(input_.X_CF[chord_], input_.X_CF[chord_ + 1]));
    }
    const Chord& chord = input_.path.chords[chord_];
    const ChordPoint point(chord, input_.shell.points[hit.point], input_.shell.normals[hit.point].cast<double>());
    const double share = options_.stiffness_per == StiffnessPer::kArea ? double(input_.shell.areas[hit.point]) : 1.0;
    stiffness_ = share * options_.stiffness;
    damping_ = share * options_.damping;

    std::vector<double>& breaks = result_.breaks;
    breaks.clear();
    if (options_.quadrature == Quadrature::kExact) {
      smoothPieces(input_.field, {point.start, point.position(1.0)}, hit.interval, breaks);
    } else {
      for (int i = 1; i < options_.midpoint_intervals; ++i) {
        const double share_of_interval = static_cast<double>(i) / options_.midpoint_intervals;
        breaks.push_back(hit.interval.enter + share_of_interval * (hit.interval.exit - hit.interval.enter));
      }
    }
    breaks.insert(breaks.begin(), hit.interval.enter);
    breaks.push_back(hit.interval.exit);
    if (!input_.siblings.empty()) splitWhereOwnerChanges(point);

    deepest_ = {};
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) addPiece(point, breaks[i], breaks[i + 1]);
    deepest_.refine([&](double s) { return valueAt(point, s); });
    result_.depths.push_back(depthOf(point, chord, hit.interval));
  }

 private:
  double valueAt(const ChordPoint& point, double s) { return field_.value(point.position(s)); }

  Vector3d fieldNormal(const ChordPoint& point, double s, const Vector3d& gradient) const {
    const double norm = gradient.norm();
    return norm > 1e-9 ? Vector3d(gradient / norm) : point.inward(s);
  }

  Vector3d normal(const ChordPoint& point, double s, const Vector3d& gradient) const {
    return options_.normal == NormalSource::kShell ? point.inward(s) : fieldNormal(point, s, gradient);
  }

  /// Whether a sibling of the field is deeper at p_F, so that the contact is not this field's.
  bool siblingOwns(const Vector3d& p_F) {
    std::optional<double> own;
    for (const SiblingField& sibling : input_.siblings) {
      const Vector3d p_G = sibling.X_GF * p_F;
      const AlignedBox3d& box = sibling.field->surfaceBox();
      // Farther than its error bound outside its surface's box, the sibling's value is positive.
      if (box.exteriorDistance(p_G) > sibling.field->errorBound()) continue;
      if (!own) own = field_.value(p_F);
      const double ahead = *own - sibling.field->interpolate(p_G).value;
      if (ahead > kTie || (ahead >= -kTie && sibling.wins_tie)) return true;
    }
    return false;
  }

  /// Adds breaks where a sibling becomes deeper or stops being so, so that every piece has one owner.
  void splitWhereOwnerChanges(const ChordPoint& point) {
    std::vector<double>& breaks = result_.breaks;
    const auto owned = [&](double s) { return siblingOwns(point.position(s)); };
    const std::size_t count = breaks.size();
    bool before = owned(breaks[0]);
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double middle = 0.5 * (breaks[i] + breaks[i + 1]);
      for (const auto& [from, to] : {std::pair{breaks[i], middle}, std::pair{middle, breaks[i + 1]}}) {
        const bool after = owned(to);
        if (after != before) {
          double low = from, high = to;
          for (int step = 0; step < 40; ++step) {
            const double half = 0.5 * (low + high);
            (owned(half) == before ? low : high) = half;
          }
          breaks.push_back(high);
        }
        before = after;
      }
    }
    std::sort(breaks.begin(), breaks.end());
  }

  void addPiece(const ChordPoint& point, double from, double to) {
    const double length = to - from;
    if (!input_.siblings.empty() && siblingOwns(point.position(0.5 * (from + to)))) {
      deepest_.startRun();
      return;
    }
    // The gradient is discontinuous between cells: the ends are evaluated slightly inside this piece.
    const double first = from + 1e-9 * length, last = to - 1e-9 * length;
    if (!request_.impulse) {
      offer(point, first);
      for (const Node& node : rule_) offer(point, from + node.s * length);
      return offer(point, last);
    }
    const FieldValue at_first = field_.interpolate(point.position(first));
    const FieldValue at_last = field_.interpolate(point.position(last));
    const bool known = at_first.gradient.norm() > 1e-9 && at_last.gradient.norm() > 1e-9;
    const bool exact = options_.quadrature == Quadrature::kExact;
    // N is linear where d is cubic, in a cell, and constant along a box's pieces; about an axis or a center it turns.
    const bool linear = exact && !is_round_ && (known || options_.normal == NormalSource::kShell);
    const Vector3d N_first = normal(point, first, at_first.gradient);
    const Vector3d N_last = normal(point, last, at_last.gradient);
    deepest_.offer(first, at_first.value);
    for (const Node& share : rule_) {
      const Node node{from + share.s * length, share.weight * length};
      FieldValue sample;
      Vector3d N;
      if (linear) {
        sample.value = valueAt(point, node.s);
        N = (1.0 - share.s) * N_first + share.s * N_last;
      } else {
        sample = field_.interpolate(point.position(node.s));
        N = normal(point, node.s, sample.gradient);
      }
      deepest_.offer(node.s, sample.value);
      addNode(point, node, sample.value, N);
    }
    deepest_.offer(last, at_last.value);
  }

  void offer(const ChordPoint& point, double s) { deepest_.offer(s, valueAt(point, s)); }

  void addNode(const ChordPoint& point, const Node& node, double value, const Vector3d& N_F) {
    Vector3d F_F = -stiffness_ * std::min(value, 0.0) * N_F;  // Eq. 3, N as in design §3.6
    if (damping_ != 0.0) F_F -= damping_ * point.velocity();  // Eq. 10 with the sign that opposes the motion
    const Isometry3d& X_CF = poses_.at(node.s);
    const Vector3d impulse = node.weight * point.duration * (X_CF.linear() * F_F);  // Eq. 4
    const Vector3d r_C = X_CF * point.position(node.s);
    result_.on_shell_body += {impulse, r_C.cross(impulse)};  // Eq. 5, 11
  }

  HitDepth depthOf(const ChordPoint& point, const Chord& chord, const Interval& interval) {
    HitDepth depth;
    depth.siblings = !deepest_.found();
    if (depth.siblings) return depth;
    const double s = deepest_.s();
    const Isometry3d& X_CF = poses_.at(s);
    depth.depth = std::max(-deepest_.value(), 0.0);
    depth.time = chord.t_start + s * point.duration;
    depth.p_F = point.position(s);
    depth.p_C = X_CF * depth.p_F;
    depth.normal_C = X_CF.linear() * fieldNormal(point, s, field_.interpolate(depth.p_F).gradient);
    if (depth.depth >= input_.field.band() - input_.field.errorBound()) depth.reach = reachOf(point, interval);
    if (!request_.depth_errors) return depth;
    depth.error = input_.field.sample(depth.p_F).error;
    depth.depth_lower_bound = depth.depth - depth.error;
    if (depth.depth > input_.field.band())
      depth.depth_lower_bound = std::max(depth.depth_lower_bound, -input_.field.bounds(depth.p_F).high);
    return depth;
  }

  /// Upper bound of the depth along a part of the straight path, from those at places on it: depth is 1-Lipschitz.
  /// Only the greatest one of all points is needed precisely.
  double reachOf(const ChordPoint& point, const Interval& interval) {
    constexpr double kMostPieces = 16.0;
    const double length = (point.position(interval.exit) - point.position(interval.enter)).norm();
    const Vector3d middle = point.position(0.5 * (interval.enter + interval.exit));
    const double rough = 0.5 * length - input_.field.lowerBound(middle);
    if (rough <= greatest_reach_) return rough;
    const double wanted = std::max(1.0, std::ceil(length / input_.field.errorBound()));
    const int pieces = static_cast<int>(std::min(wanted, kMostPieces));
    double reach = 0.0, before = 0.0;
    for (int i = 0; i <= pieces; ++i) {
      const double share = static_cast<double>(i) / pieces;
      const FieldSample sample =
          input_.field.sample(point.position((1.0 - share) * interval.enter + share * interval.exit));
      const double greatest = std::max(0.0, sample.error - sample.value);
      if (i > 0) reach = std::max(reach, 0.5 * (before + greatest + length / pieces));
      before = greatest;
    }
    greatest_reach_ = std::max(greatest_reach_, reach);
    return reach;
  }

  const ContactInput& input_;
  CellReader field_;
  bool is_round_;  // the field is a sphere or a cylinder
  const ContactOptions& options_;
  const std::vector<Node>& rule_;  // on each piece
  const ContactRequest& request_;
  ContactImpulse& result_;
  int chord_ = -1;
  ChordPoses poses_;
  double stiffness_ = 0.0;       // of this point [N/m]
  double damping_ = 0.0;         // of this point [N·s/m]
  double greatest_reach_ = 0.0;  // of all points so far [m]
  Deepest deepest_;
};

}  // namespace

void validate(const ContactOptions& options) {
  const auto require = [](double value, const char* name) {
    if (!(value >= 0.0) || !std::isfinite(value))
      throw std::invalid_argument("contact: " + std::string(name) + " must be finite and not negative, got " +
                                  numberText(value));
  };
  require(options.stiffness, "stiffness");
  require(options.damping, "damping");
  if (options.midpoint_intervals < 1)
    throw std::invalid_argument("contact: midpoint_intervals must be 1 or more, got " +
                                std::to_string(options.midpoint_intervals));
}

void integrateContact(const ContactInput& input, const std::vector<ShellHit>& hits, const ContactOptions& options,
                      const ContactRequest& request, ContactImpulse& result) {
  if (input.X_CF.size() != input.path.chords.size() + 1)
    throw std::invalid_argument("contact: " + std::to_string(input.path.chords.size()) + " chords need " +
                                std::to_string(input.path.chords.size() + 1) + " poses X_CF, got " +
                                std::to_string(input.X_CF.size()));
  result.on_shell_body = {};
  result.depths.clear();
  Integrator integrator(input, options, request, result);
  CancelTicks<> cancel;
  for (const ShellHit& hit : hits) {
    cancel.check();
    integrator.add(hit);
  }
}

}  // namespace sdf_ccd
