#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// Adversaries of the verdicts: families of motions whose truth is known from elsewhere (test/oracle/).
namespace sdf_ccd::test {

/// What became of a family's cases.
struct Tally {
  long cases = 0;
  long clear = 0, contact = 0, uncertain = 0, not_checked = 0;
  long false_clear = 0;       ///< CLEAR, and the bodies certainly meet
  long false_contact = 0;     ///< CONTACT, and the bodies certainly stay apart
  long false_bound = 0;       ///< a clearance or depth that is wrong by more than the error reported with it
  long opposite = 0;          ///< CLEAR in one telling of a case and CONTACT in another
  long near = 0, placed = 0;  ///< of the cases whose true distance is known (placed): less than three error bounds
  double deepest = 0.0;       ///< true depth while CLEAR [m]
  std::vector<float> bound_over_error;  ///< reported error / |reported depth or clearance − truth|

  struct Failure {
    long count = 0;
    std::string first;  ///< with figures
  };
  std::map<std::string, Failure> failures;  ///< by what failed

  Tally& operator+=(const Tally& other);

  void fail(const std::string& what, const std::string& figures);

  /// Of all cases: no false verdict and no false bound.
  bool holds() const { return false_clear == 0 && false_contact == 0 && false_bound == 0 && opposite == 0; }

  double uncertainShare() const { return cases > 0 ? double(uncertain) / double(cases) : 0.0; }
  double nearShare() const { return placed > 0 ? double(near) / double(placed) : 0.0; }
  double medianBoundOverError() const;
};

struct Family {
  const char* name;
  /// Equal seeds give equal cases.
  Tally (*run)(std::uint64_t seed, long cases);
  long fast_cases;  ///< that take a few seconds
};

Tally bothMove(std::uint64_t seed, long cases);
Tally degenerate(std::uint64_t seed, long cases);
Tally topology(std::uint64_t seed, long cases);
Tally metamorphic(std::uint64_t seed, long cases);
Tally search(std::uint64_t seed, long cases);
Tally parts(std::uint64_t seed, long cases);

/// All that need no ROS.
std::vector<Family> families();

}  // namespace sdf_ccd::test
