#pragma once
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::python {

/// A model and the text of its file: what Python calculates with is always what a file would give.
struct KeptModel {
  std::string text;
  model::Model model;

  /// `file` names it in messages.
  KeptModel(std::string from, const std::string& file) : text(std::move(from)), model(model::parse_model(text, file)) {}
};
using SharedModel = std::shared_ptr<KeptModel>;

/// By the name that it has in Python. Throws std::invalid_argument.
inline estimation::Estimator estimator_named(const std::string& name) {
  if (name == "condensed") return estimation::Estimator::condensed;
  if (name == "observer") return estimation::Estimator::observer;
  throw std::invalid_argument(fmt::format("estimator: {} not in {{condensed,observer}}", name));
}

}  // namespace spoolflow::python
