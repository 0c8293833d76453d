#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "measurement.h"
#include "timing.h"

namespace sdf_ccd::precision {

/// A system at one setting.
template <class Answer>
struct System {
  Label label;
  std::function<void(std::vector<Answer>&)> answer;  ///< runs all queries of the study, and sets an answer to each
};

/// What the answers are compared in.
template <class Answer>
struct Quantity {
  std::string name, unit;
  std::function<double(std::size_t query, const Answer&)> error;  ///< NaN if there is an answer, but this is none
  bool bounded = false;                                           ///< Label::bound is of this quantity
};

/// Cost and error of every system over the same queries: a row per quantity and system, but for systems without any
/// answer.
/// @param progress  called with the fraction done.
template <class Answer>
std::vector<Measurement> measure(const std::vector<System<Answer>>& systems, std::size_t queries,
                                 const std::vector<Quantity<Answer>>& quantities,
                                 const std::function<void(double)>& progress) {
  std::vector<std::vector<Answer>> found(systems.size(), std::vector<Answer>(queries));
  std::vector<std::function<void()>> tasks;
  for (std::size_t k = 0; k < systems.size(); ++k) tasks.push_back([&, k] { systems[k].answer(found[k]); });
  const std::vector<double> seconds = secondsPerQuery(tasks, queries, progress);
  std::vector<Measurement> rows;
  for (const Quantity<Answer>& quantity : quantities) {
    for (std::size_t k = 0; k < systems.size(); ++k) {
      Measurement row{systems[k].label, quantity.name, quantity.unit, seconds[k]};
      if (!quantity.bounded) row.bound = Label::kNone;
      std::vector<double> errors;
      for (std::size_t i = 0; i < queries; ++i) {
        const double error = quantity.error(i, found[k][i]);
        if (!std::isnan(error)) errors.push_back(error);
      }
      row.missed = queries - errors.size();
      if (errors.empty()) continue;
      row.error = summarize(std::move(errors));
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace sdf_ccd::precision
