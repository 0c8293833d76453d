#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sdf_ccd/ContactArray.h"

namespace sdf_ccd::tools {

/// The contacts that messages tell of, each as the last one has it.
class ContactRecords {
 public:
  void add(const ContactArray& message);

  /// All contacts up to now, by their begin.
  std::vector<Contact> contacts() const;

 private:
  std::vector<Contact> contacts_;
  std::map<std::uint64_t, std::size_t> known_;  // by id
};

/// contacts.csv: the columns' names, and a contact's row.
std::string contactColumns();
std::string toRow(const Contact& contact);

}  // namespace sdf_ccd::tools
