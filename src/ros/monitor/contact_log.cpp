#include "ros/monitor/contact_log.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

std::string timeText(std::chrono::nanoseconds time) {
  return fmt::format("{:.3f}", std::chrono::duration<double>(time).count());
}

std::string beginLine(const TrackedContact& contact) {
  const std::string depth =
      contact.deepest.depth > 0.0 ? ", " + lengthText(contact.deepest.depth) + " deep so far" : std::string();
  return fmt::format("Contact begins: {} - {} at {}{}", contact.body_a, contact.body_b, timeText(contact.begin), depth);
}

std::string endLine(const TrackedContact& contact) {
  std::string line =
      fmt::format("Contact {}: {} - {} at {} after {:.3f} s", contact.is_lost ? "is no longer checked" : "ends",
                  contact.body_a, contact.body_b, timeText(contact.end),
                  std::chrono::duration<double>(contact.end - contact.begin).count());
  if (contact.deepest.depth > 0.0) {
    line += fmt::format(", up to {} deep (error {})", lengthText(contact.deepest.depth),
                        lengthText(contact.deepest.depth_error));
  }
  if (contact.max_force > 0.0) line += fmt::format(", {:.3g} N", contact.max_force);
  return line;
}

}  // namespace

std::vector<std::string> ContactLog::update(const ContactTracker& contacts, const ros::WallTime& now) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const TrackedContact& contact = contacts[i];
    const auto begun = std::find(begun_.begin(), begun_.end(), contact.id);
    if (contact.verdict == Verdict::kContact && begun == begun_.end()) {
      add(beginLine(contact), now, lines);
      if (!contact.ends) begun_.push_back(contact.id);
      if (contact.ends) add(endLine(contact), now, lines);
    } else if (contact.ends && begun != begun_.end()) {
      add(endLine(contact), now, lines);
      begun_.erase(begun);
    }
  }
  return lines;
}

void ContactLog::add(const std::string& line, const ros::WallTime& now, std::vector<std::string>& lines) {
  if ((now - second_).toSec() >= 1.0 || now < second_) {
    second_ = now;
    lines_ = 0;
  }
  if (lines_ >= kPerSecond) {
    ++left_out_;
    return;
  }
  ++lines_;
  lines.push_back(left_out_ > 0 ? fmt::format("{} (and {} lines about contacts before it)", line, left_out_) : line);
  left_out_ = 0;
}

}  // namespace sdf_ccd
