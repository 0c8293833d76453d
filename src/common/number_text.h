#pragma once

#include <string>

#include <fmt/format.h>

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

/// A length [m] in mm, from one metre on in m: "0.002 mm", "13.4 mm", "1.34 m".
inline std::string lengthText(double length) {
  return length < 0.9995 ? shortText(1e3 * length) + " mm" : fixedText(length, 2) + " m";
}

/// A duration [s]: "0.0123 s", "1234 s".
inline std::string durationText(double seconds) {
  return (seconds < 999.5 ? shortText(seconds) : fixedText(seconds, 0)) + " s";
}

/// Memory [bytes] in units of 10⁶: "0.0123 MB", "1234 MB".
inline std::string memoryText(double bytes) {
  const double megabytes = 1e-6 * bytes;
  return (megabytes < 999.5 ? shortText(megabytes) : fixedText(megabytes, 0)) + " MB";
}

}  // namespace sdf_ccd
