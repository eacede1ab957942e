#pragma once
/// The program's work as requests and answers in JSON, on the files of one folder: what a page in a browser asks.
#include <memory>
#include <string>
#include <string_view>

#include "addons/playground/requests/recorded_work.hpp"

namespace spoolflow::playground {

class VirtualValve;

class Playground {
 public:
  explicit Playground(Outlet outlet);
  ~Playground();
  Playground(const Playground&) = delete;
  Playground& operator=(const Playground&) = delete;

  /// `request` is an object whose "work" says what to do with the files that it names:
  ///
  ///     version
  ///     inspect    file, channels                            text and inspection
  ///     calibrate  campaign, model, report, despite_doubts   writes model and report; sentence, doubts, summary
  ///     estimate   model, recording, channels, output        writes the CSV; sentence, notes, doubts
  ///     validate   model, recordings, channels, report, metrics   writes both; verdict, limits
  ///     simulate   scenario, recording, truth                writes both
  ///     play_begin model                                     a new valve of the virtual rig
  ///     play       duration_s and what ValveSettings says, in percent, bar, degC, um, A, Hz      columns of samples
  ///
  /// "channels" is a map's file or empty. The answer is an object; where the work fails, of "error" alone: the
  /// program's own words. Throws nothing of the program's.
  [[nodiscard]] std::string answer(std::string_view request);

 private:
  Outlet outlet_;
  std::unique_ptr<VirtualValve> valve_;
};

}  // namespace spoolflow::playground
