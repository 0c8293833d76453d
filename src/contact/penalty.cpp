#include "penalty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cell_paths.h"
#include "chord_frame.h"
#include "common/cancel_point.h"
#include "common/number_text.h"
#include "deepest.h"
#include "field/cell_reader.h"
#include "field/field_access.h"
#include "query/smooth_pieces.h"
#include "sdf_ccd/segments.h"
#include "smooth_piece.h"

namespace sdf_ccd {
namespace {

const std::vector<QuadratureNode> kGauss(kGaussNodes.begin(), kGaussNodes.end());
const std::vector<QuadratureNode> kMidpoint = {{0.5, 1.0}};

/// Whether a field's gradient is known, which it is not far inside.
bool hasDirection(const Vector3d& gradient) {
  return gradient.squaredNorm() > kNoDirection2;
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
        impulses_(result.on_shell_body),
        may_add_to_ways_(request.impulse && options.quadrature == Quadrature::kExact &&
                         options.normal == NormalSource::kField && input.siblings.empty() && !input.field.primitive()),
        reach_from_(input.field.band() - input.field.errorBound()) {}

  /// Adds a hit, and sets its depth then or later, but before finish().
  void add(const ShellHit& hit, HitDepth& depth) {
    if (hit.chord != chord_) {
      finish();
      chord_ = hit.chord;
      impulses_.begin(ChordFrame(input_.X_CF[chord_], input_.X_CF[chord_ + 1]));
    }
    if (!addToWays(hit, depth)) addAlone(hit, depth);
  }

  void finish() {
    addPaths();
    in_cells_.moveTo(impulses_);
    impulses_.finish();
  }

 private:
  struct Pending {
    const ShellHit* hit;
    HitDepth* depth;
    ChordPoint point;
  };

  /// Keeps a hit until there are as many as can be added together. @return false if it cannot be.
  bool addToWays(const ShellHit& hit, HitDepth& depth) {
    if (!may_add_to_ways_ || hit.interval.enter != 0.0 || hit.interval.exit != 1.0) return false;
    const int lane = pending_count_;
    pending_[lane] = {&hit, &depth, pointOf(hit)};
    const ChordPoint& point = pending_[lane].point;
    if (!FieldAccess::grid(input_.field) && !placeInLeaf(point, lane)) return false;
    for (int k = 0; k < 3; ++k) {
      paths_.start[k][lane] = point.start[k];
      paths_.step[k][lane] = point.step[k];
    }
    const double share = shareOf(hit);
    paths_.stiffness[lane] = share * options_.stiffness;
    paths_.damping[lane] = share * options_.damping;
    if (++pending_count_ == CellPaths::kCount) addPaths();
    return true;
  }

  /// As placeInGrid(), for a lane.
  bool placeInLeaf(const ChordPoint& point, int lane) {
    CellLine line;
    if (!field_.enter(point.start, point.position(1.0), line)) return false;
    for (int k = 0; k < 8; ++k) paths_.corners[k][lane] = field_.corners()[k];
    for (int k = 0; k < 3; ++k) {
      paths_.from[k][lane] = line.from[k];
      paths_.to[k][lane] = line.to[k];
    }
    paths_.side[lane] = field_.side();
    return true;
  }

  void addPaths() {
    if (pending_count_ == 0) return;
    unsigned placed = (1U << pending_count_) - 1;
    if (const SparseGrid* grid = FieldAccess::grid(input_.field)) placed &= placeInGrid(*grid, paths_);
    for (int lane = 0; lane < CellPaths::kCount; ++lane)
      if ((placed >> lane & 1U) == 0) paths_.stiffness[lane] = paths_.damping[lane] = 0.0;
    CellDepths deepest;
    if (placed != 0) in_cells_.add(paths_, pending_[0].point.duration(), deepest);
    for (int lane = 0; lane < pending_count_; ++lane) {
      const auto& [hit, depth, point] = pending_[lane];
      if ((placed >> lane & 1U) == 0 || deepest.bears[lane] == 0.0) {
        addAlone(*hit, *depth);
        continue;
      }
      is_smooth_ = true;
      const double u = deepest.u[lane], s = std::clamp(u, kInside, 1.0 - kInside);
      if (u == 0.0 || u == 1.0) {
        const Vector3d normal(deepest.normal[0][lane], deepest.normal[1][lane], deepest.normal[2][lane]);
        setDepth(point, hit->interval, s, deepest.value[lane], normal, *depth);
      } else {
        setDepth(point, hit->interval, s, deepest.value[lane], normalAt(point, s), *depth);
      }
    }
    pending_count_ = 0;
  }

  void addAlone(const ShellHit& hit, HitDepth& depth) {
    const ChordPoint point = pointOf(hit);
    const double share = shareOf(hit);
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
    depth.siblings = !deepest_.found();
    if (depth.siblings) return;
    const double s = deepest_.s();
    const Vector3d normal = end_.s == s ? fieldNormal(point, s, end_.gradient) : normalAt(point, s);
    setDepth(point, hit.interval, s, deepest_.value(), normal, depth);
  }

  ChordPoint pointOf(const ShellHit& hit) const {
    return {input_.path.chords[hit.chord], input_.shell.point(hit.point), input_.shell.normals[hit.point]};
  }

  /// What a point's stiffness and damping are multiplied by.
  double shareOf(const ShellHit& hit) const {
    return options_.stiffness_per == StiffnessPer::kArea ? double(input_.shell.areas[hit.point]) : 1.0;
  }

  Vector3d normalAt(const ChordPoint& point, double s) {
    return fieldNormal(point, s, field_.interpolate(point.position(s)).gradient);
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
    for (const QuadratureNode& share : rule_) {
      const QuadratureNode node{from + share.s * length, share.weight * length};
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
    for (const QuadratureNode& share : kGauss) {
      const QuadratureNode node{from + share.s * length, share.weight * length};
      addNode(point, node, piece_.distance(share.s), normal(point, node.s, piece_.gradient(share.s)));
    }
  }

  void offer(const ChordPoint& point, double s) { deepest_.offer(s, valueAt(point, s)); }

  void addNode(const ChordPoint& point, const QuadratureNode& node, double value, const Vector3d& N_F) {
    Vector3d F_F = -stiffness_ * std::min(value, 0.0) * N_F;  // Eq. 3, N as in design §3.6
    if (damping_ != 0.0) F_F -= damping_ * point.velocity();  // Eq. 10 with the sign that opposes the motion
    impulses_.add(node.s, point.position(node.s), (node.weight * point.duration()) * F_F);  // Eq. 4, 5, 11
  }

  void setDepth(const ChordPoint& point, const Interval& times, double s, double value, const Vector3d& normal_F,
                HitDepth& depth) {
    const Isometry3d& X_CF = impulses_.poseAt(s);
    depth.siblings = false;
    depth.depth = std::max(-value, 0.0);
    depth.time = point.chord->t_start + s * point.duration();
    depth.p_F = point.position(s);
    depth.p_C = X_CF * depth.p_F;
    depth.normal_C = X_CF.linear() * normal_F;
    depth.reach = depth.depth >= reach_from_ ? reachOf(point, times, depth.depth) : 0.0;
    depth.error = request_.depth_errors ? depthError(input_.field, depth.p_F, depth.depth) : 0.0;
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
  const std::vector<QuadratureNode>& rule_;  // on each piece
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
  bool may_add_to_ways_;
  double reach_from_;  // depth from which on a point's reach is reported [m]
  CellPaths paths_;
  std::array<Pending, CellPaths::kCount> pending_;  // of paths_
  int pending_count_ = 0;
  CellImpulses in_cells_;
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
  result.depths.resize(hits.size());
  Integrator integrator(input, options, request, result);
  CancelTicks<> cancel;
  for (std::size_t h = 0; h < hits.size(); ++h) {
    cancel.check();
    integrator.add(hits[h], result.depths[h]);
  }
  integrator.finish();
}

}  // namespace sdf_ccd
