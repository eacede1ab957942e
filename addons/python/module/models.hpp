#pragma once
#include <memory>
#include <sstream>
#include <string>

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

}  // namespace spoolflow::python
