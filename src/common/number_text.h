#pragma once

#include <string>

#include <fmt/format.h>

#include "sdf_ccd/types.h"

/// Numbers as text, for messages and tables.
namespace sdf_ccd {

/// In six digits: also 1e300, of which std::to_string() would print 308.
inline std::string numberText(double value) {
  return fmt::format("{:g}", value);
}

/// In three digits.
inline std::string shortText(double value) {
  return fmt::format("{:.3g}", value);
}

/// With this many decimals.
inline std::string fixedText(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

/// A point or direction: "(0, 1.5, -2)".
inline std::string vectorText(const Vector3d& v) {
  return fmt::format("({:g}, {:g}, {:g})", v.x(), v.y(), v.z());
}

/// A length [m] in mm, from one metre on in m: "0.002 mm", "13.4 mm", "1.34 m".
inline std::string lengthText(double length) {
  return length < 0.9995 ? shortText(1e3 * length) + " mm" : fixedText(length, 2) + " m";
}

/// A run time [s] in three digits: "0.0123 s", "1234 s".
inline std::string durationText(double seconds) {
  return (seconds < 999.5 ? shortText(seconds) : fixedText(seconds, 0)) + " s";
}

/// A time or duration [s] with this many decimals: "0.250 s".
inline std::string secondsText(double seconds, int decimals) {
  return fixedText(seconds, decimals) + " s";
}

/// Memory [bytes] in units of 10⁶: "0.0123 MB", "1234 MB".
inline std::string memoryText(double bytes) {
  const double megabytes = 1e-6 * bytes;
  return (megabytes < 999.5 ? shortText(megabytes) : fixedText(megabytes, 0)) + " MB";
}

}  // namespace sdf_ccd
