#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// Adversarial families of motions, whose truth is computed independently (test/oracle/).
namespace sdf_ccd::test {

/// Results of a family's cases.
struct Tally {
  long cases = 0;
  long clear = 0, contact = 0, uncertain = 0, not_checked = 0;
  long false_clear = 0;       ///< CLEAR although the bodies certainly have contact
  long false_contact = 0;     ///< CONTACT although the bodies certainly stay apart
  long false_bound = 0;       ///< clearances or depths that are wrong by more than the reported error
  long opposite = 0;          ///< CLEAR in one variant of a case and CONTACT in another
  long near = 0, placed = 0;  ///< cases with a known true distance (placed), and those below three error bounds
  double deepest = 0.0;       ///< largest true depth while CLEAR [m]
  std::vector<float> bound_over_error;  ///< reported error / |reported depth or clearance − truth|

  struct Failure {
    long count = 0;
    std::string first;  ///< text of the first one, with numbers
  };
  std::map<std::string, Failure> failures;  ///< by kind of failure

  Tally& operator+=(const Tally& other);

  void fail(const std::string& what, const std::string& figures);

  /// Whether no case has a false verdict or a false bound.
  bool holds() const { return false_clear == 0 && false_contact == 0 && false_bound == 0 && opposite == 0; }

  double uncertainShare() const { return cases > 0 ? double(uncertain) / double(cases) : 0.0; }
  double nearShare() const { return placed > 0 ? double(near) / double(placed) : 0.0; }
  double medianBoundOverError() const;
};

struct Family {
  const char* name;
  /// Runs at least `cases` cases. Equal seeds give equal cases.
  Tally (*run)(std::uint64_t seed, long cases);
  long fast_cases;  ///< number of cases that takes a few seconds
};

Tally bothMove(std::uint64_t seed, long cases);
Tally degenerate(std::uint64_t seed, long cases);
Tally topology(std::uint64_t seed, long cases);
Tally metamorphic(std::uint64_t seed, long cases);
Tally search(std::uint64_t seed, long cases);
Tally parts(std::uint64_t seed, long cases);

/// All families that need no ROS.
std::vector<Family> families();

}  // namespace sdf_ccd::test
