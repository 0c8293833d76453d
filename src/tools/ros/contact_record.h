#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sdf_ccd/ContactArray.h"

namespace sdf_ccd::tools {

/// Collects the contacts of messages; of each contact, the state in the last message that holds it.
class ContactRecords {
 public:
  void add(const ContactArray& message);

  /// All contacts added so far, sorted by begin.
  std::vector<Contact> contacts() const;

 private:
  std::vector<Contact> contacts_;
  std::map<std::uint64_t, std::size_t> known_;  // by id
};

/// contacts.csv: the header, and the row of a contact.
std::string contactColumns();
std::string toRow(const Contact& contact);

}  // namespace sdf_ccd::tools
