#include "penalty.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "chord_frame.h"
#include "chord_impulses.h"
#include "common/number_text.h"
#include "deepest.h"
#include "field/cell_reader.h"
#include "sdf_ccd/common/cancel.h"
#include "sdf_ccd/query/segment_query.h"
#include "smooth_piece.h"

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

/// Whether a field's gradient is known, which it is not far inside.
bool hasDirection(const Vector3d& gradient) {
  return gradient.squaredNorm() > 1e-18;
}

// Where two pieces meet, the gradient may be discontinuous, and an adaptive field may jump: ends are taken to be inside
// of a piece by this share of it.
constexpr double kInside = 1e-9;

// Values of sibling fields that differ by less than this, the rounding of their poses, count as equal [m].
constexpr double kTie = 1e-9;

/// An end of a smooth piece at which a point is deepest.
struct PieceEnd {
  double s;  // -1: none
  Vector3d gradient;
};

class Integrator {
 public:
  Integrator(const ContactInput& input, const ContactOptions& options, const ContactRequest& request,
             ContactImpulse& result)
      : input_(input),
        field_(input.field),
        smooth_(input.field, field_),
        options_(options),
        rule_(options.quadrature == Quadrature::kExact ? kGauss : kMidpoint),
        request_(request),
        result_(result),
        impulses_(result.on_shell_body) {}

  void add(const ShellHit& hit) {
    if (hit.chord != chord_) {
      chord_ = hit.chord;
      impulses_.begin(ChordFrame(input_.X_CF[chord_], input_.X_CF[chord_ + 1]));
    }
    const ChordPoint point = pointOf(hit);
    const double share = options_.stiffness_per == StiffnessPer::kArea ? double(input_.shell.areas[hit.point]) : 1.0;
    stiffness_ = share * options_.stiffness;
    damping_ = share * options_.damping;

    deepest_ = {};
    end_.s = -1.0;
    is_smooth_ = readWay(point, hit.interval);
    if (is_smooth_) {
      addSmooth(point, hit.interval.enter, hit.interval.exit);
    } else {
      addPieces(point, hit.interval);
    }
    deepest_.refine([&](double s) { return valueAt(point, s); });
    result_.depths.push_back(depthOf(point, hit.interval));
  }

  void finish() { impulses_.finish(); }

 private:
  ChordPoint pointOf(const ShellHit& hit) const {
    return {input_.path.chords[hit.chord], input_.shell.point(hit.point), input_.shell.normals[hit.point]};
  }

  double valueAt(const ChordPoint& point, double s) { return field_.value(point.position(s)); }

  /// Whether the field is one smooth piece during a hit, as it mostly is at the rate of a robot's cycles: reads it.
  bool readWay(const ChordPoint& point, const Interval& times) {
    return options_.quadrature == Quadrature::kExact && input_.siblings.empty() &&
           smooth_.readWay(point.position(times.enter), point.position(times.exit), piece_);
  }

  void addPieces(const ChordPoint& point, const Interval& times) {
    std::vector<double>& breaks = result_.breaks;
    breaks.clear();
    if (options_.quadrature == Quadrature::kExact) {
      smoothPieces(input_.field, {point.start, point.position(1.0)}, times, breaks);
    } else {
      for (int i = 1; i < options_.midpoint_intervals; ++i) {
        const double share = static_cast<double>(i) / options_.midpoint_intervals;
        breaks.push_back(times.enter + share * (times.exit - times.enter));
      }
    }
    breaks.insert(breaks.begin(), times.enter);
    breaks.push_back(times.exit);
    if (!input_.siblings.empty()) splitWhereOwnerChanges(point);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) addPiece(point, breaks[i], breaks[i + 1]);
  }

  Vector3d fieldNormal(const ChordPoint& point, double s, const Vector3d& gradient) const {
    return hasDirection(gradient) ? Vector3d(gradient.normalized()) : point.inward(s);
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
    if (options_.quadrature == Quadrature::kExact &&
        smooth_.readPiece(point.position(from), point.position(to), piece_))
      return addSmooth(point, from, to);
    offer(point, from + kInside * length);
    for (const Node& share : rule_) {
      const Node node{from + share.s * length, share.weight * length};
      if (!request_.impulse) {
        offer(point, node.s);
        continue;
      }
      const FieldValue at = field_.interpolate(point.position(node.s));
      deepest_.offer(node.s, at.value);
      addNode(point, node, at.value, normal(point, node.s, at.gradient));
    }
    offer(point, to - kInside * length);
  }

  /// Adds piece_.
  void addSmooth(const ChordPoint& point, double from, double to) {
    const double length = to - from;
    const CubicMinimum lowest = minimumOf(piece_.distance);
    const double s = from + std::clamp(lowest.u, kInside, 1.0 - kInside) * length;
    if (deepest_.offerMinimum(s, lowest.value) && (lowest.u == 0.0 || lowest.u == 1.0))
      end_ = {s, lowest.u == 0.0 ? piece_.gradient_first : piece_.gradient_last};
    if (!request_.impulse) return;
    // N is nearly linear where d is cubic, in a cell.
    const Vector3d N_first = normal(point, from, piece_.gradient_first);
    const Vector3d N_last = normal(point, to, piece_.gradient_last);
    for (const Node& node : kGauss)
      addNode(point, {from + node.s * length, node.weight * length}, piece_.distance(node.s),
              (1.0 - node.s) * N_first + node.s * N_last);
  }

  void offer(const ChordPoint& point, double s) { deepest_.offer(s, valueAt(point, s)); }

  void addNode(const ChordPoint& point, const Node& node, double value, const Vector3d& N_F) {
    Vector3d F_F = -stiffness_ * std::min(value, 0.0) * N_F;  // Eq. 3, N as in design §3.6
    if (damping_ != 0.0) F_F -= damping_ * point.velocity();  // Eq. 10 with the sign that opposes the motion
    impulses_.add(node.s, point.position(node.s), (node.weight * point.duration()) * F_F);  // Eq. 4, 5, 11
  }

  HitDepth depthOf(const ChordPoint& point, const Interval& times) {
    HitDepth depth;
    depth.siblings = !deepest_.found();
    if (depth.siblings) return depth;
    const double s = deepest_.s();
    const Isometry3d& X_CF = impulses_.poseAt(s);
    depth.depth = std::max(-deepest_.value(), 0.0);
    depth.time = point.chord.t_start + s * point.duration();
    depth.p_F = point.position(s);
    depth.p_C = X_CF * depth.p_F;
    const Vector3d gradient = end_.s == s ? end_.gradient : field_.interpolate(depth.p_F).gradient;
    depth.normal_C = X_CF.linear() * fieldNormal(point, s, gradient);
    if (depth.depth >= input_.field.band() - input_.field.errorBound())
      depth.reach = reachOf(point, times, depth.depth);
    if (!request_.depth_errors) return depth;
    depth.error = depthError(input_.field, depth.p_F, depth.depth);
    depth.depth_lower_bound = depth.depth - depth.error;
    if (depth.depth > input_.field.band())
      depth.depth_lower_bound = std::max(depth.depth_lower_bound, -input_.field.bounds(depth.p_F).high);
    return depth;
  }

  /// Upper bound of the depth along a part of the straight path, from those at places on it: depth is 1-Lipschitz.
  /// Only the greatest one of all points is needed precisely. @param depth  as found there [m].
  double reachOf(const ChordPoint& point, const Interval& times, double depth) {
    constexpr double kMostPieces = 16.0;
    // Of a smooth piece, that is the interpolated field's greatest depth.
    const double rough = depth + input_.field.errorBound();
    if (is_smooth_ && rough <= greatest_reach_) return rough;
    const double length = (point.position(times.exit) - point.position(times.enter)).norm();
    const auto greatestAt = [&](double share) {
      const FieldSample sample = input_.field.sample(point.position((1.0 - share) * times.enter + share * times.exit));
      return std::max(0.0, sample.error - sample.value);
    };
    double reach = 0.5 * length - input_.field.lowerBound(point.position(0.5 * (times.enter + times.exit)));
    if (length > input_.field.errorBound() && reach > greatest_reach_) {
      const int pieces = static_cast<int>(std::min(std::ceil(length / input_.field.errorBound()), kMostPieces));
      reach = 0.0;
      double before = greatestAt(0.0);
      for (int i = 1; i <= pieces; ++i) {
        const double after = greatestAt(static_cast<double>(i) / pieces);
        reach = std::max(reach, 0.5 * (before + after + length / pieces));
        before = after;
      }
    }
    greatest_reach_ = std::max(greatest_reach_, reach);
    return reach;
  }

  const ContactInput& input_;
  CellReader field_;
  SmoothPieceReader smooth_;
  SmoothPiece piece_;  // read last
  const ContactOptions& options_;
  const std::vector<Node>& rule_;  // on each piece
  const ContactRequest& request_;
  ContactImpulse& result_;
  int chord_ = -1;
  ChordImpulses impulses_;
  double stiffness_ = 0.0;       // of this point [N/m]
  double damping_ = 0.0;         // of this point [N·s/m]
  double greatest_reach_ = 0.0;  // of all points so far [m]
  Deepest deepest_;
  PieceEnd end_;
  bool is_smooth_ = false;  // this hit is one smooth piece
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

double depthError(const DistanceField& field, const Vector3d& p_F, double depth) {
  const FieldSample there = field.sample(p_F);
  return there.error + std::abs(there.value + depth);
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
  integrator.finish();
}

}  // namespace sdf_ccd
