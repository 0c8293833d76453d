#include "smooth_piece.h"

#include <optional>

#include "field/trilinear_cell.h"

namespace sdf_ccd {
namespace {

/// The distance from a plane.
void readPlane(const HalfSpace& plane, const Vector3d& from, const Vector3d& to, SmoothPiece& piece) {
  piece.distance = {{plane.normal.dot(from) - plane.offset, plane.normal.dot(to - from), 0.0, 0.0}};
  piece.gradient_first = piece.gradient_middle = piece.gradient_last = plane.normal;
}

/// The plane to which a point inside is nearest; none if the surface is not made of planes.
std::optional<HalfSpace> nearestFace(const Primitive& primitive, const Vector3d& p) {
  if (const HalfSpace* plane = std::get_if<HalfSpace>(&primitive)) return *plane;
  const Box* box = std::get_if<Box>(&primitive);
  if (!box) return std::nullopt;
  int axis = 0;
  (p.cwiseAbs() - box->halfSize()).maxCoeff(&axis);
  return HalfSpace{p[axis] < 0.0 ? Vector3d(-Vector3d::Unit(axis)) : Vector3d(Vector3d::Unit(axis)),
                   box->halfSize()[axis]};
}

}  // namespace

bool SmoothPieceReader::readWay(const Vector3d& from, const Vector3d& to, SmoothPiece& piece) {
  if (!primitive_) {
    CellLine line;
    if (!cells_.enter(from, to, line)) return false;
    readCell(line, piece);
    return true;
  }
  // Where a linear function is the largest of several at both ends, it is so in between.
  const std::optional<HalfSpace> face = nearestFace(*primitive_, from);
  if (!face || nearestFace(*primitive_, to)->normal != face->normal) return false;
  readPlane(*face, from, to, piece);
  return true;
}

bool SmoothPieceReader::readPiece(const Vector3d& from, const Vector3d& to, SmoothPiece& piece) {
  if (!primitive_) {
    CellLine line;
    if (!cells_.enterMiddle(from, to, line)) return false;
    readCell(line, piece);
    return true;
  }
  const std::optional<HalfSpace> face = nearestFace(*primitive_, 0.5 * (from + to));
  if (face) readPlane(*face, from, to, piece);
  return face.has_value();
}

void SmoothPieceReader::readCell(const CellLine& line, SmoothPiece& piece) const {
  const double per_side = 1.0 / cells_.side();
  piece.distance = cellCubic(cells_.corners(), line.from, line.to, 0.0);
  piece.gradient_first = per_side * trilinearGradient(cells_.corners(), line.from);
  piece.gradient_middle = per_side * trilinearGradient(cells_.corners(), 0.5 * (line.from + line.to));
  piece.gradient_last = per_side * trilinearGradient(cells_.corners(), line.to);
}

}  // namespace sdf_ccd
