#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/ContactArray.h"
#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd::tools {

/// What one pair did without a break, over however many cycles.
struct ContactRecord {
  std::string body_a, body_b;
  ros::Time start, end;
  Verdict verdict = Verdict::kUncertain;  ///< kContact if the pair's was, in a cycle, for this
  PointContact deepest;                   ///< in the fixed frame
  double error_bound = 0.0;               ///< largest of the cycles [m]
  unsigned cycles = 0;
  bool seen_at_samples = false;  ///< by a check at the recorded transforms alone
};

/// Joins the intervals of contact that cycles cut.
class ContactJoiner {
 public:
  /// @param message  of the next cycle; one that begins before the last one's end begins anew.
  void add(const ContactArray& message);

  /// All contacts up to now, by their start.
  std::vector<ContactRecord> contacts() const;

 private:
  ros::Time until_;  // the last cycle's end
  std::vector<ContactRecord> contacts_;
  std::map<std::pair<std::string, std::string>, std::size_t> last_;  // of each pair
};

/// contacts.csv: the columns' names, and a contact's row.
std::string contactColumns();
std::string toRow(const ContactRecord& record);

}  // namespace sdf_ccd::tools
