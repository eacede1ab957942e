#pragma once
/// Whether what a valve's sender delivers can be of the valve of its model, in the units that it should have: half a
/// minute of samples in which the spool moves is held against what recordings are held against, once after each begin
/// of a sender and, as long as that finds something, again and again. Of sources with senders: udp, tcp, mqtt, pipe.
#include <memory>
#include <string>
#include <vector>

#include "addons/live/site.hpp"
#include "addons/live/sources/sample_block.hpp"

namespace spoolflow::live {

class FirstSamples {
 public:
  explicit FirstSamples(const SiteSettings& site);
  ~FirstSamples();
  FirstSamples(const FirstSamples&) = delete;
  FirstSamples& operator=(const FirstSamples&) = delete;

  /// The valve's next samples, from one thread at a time a valve. Quick, and mostly nothing: the judgement has a thread
  /// of its own.
  void take(std::size_t valve, const SampleBlock& block);
  /// A sentence each; empty: nothing speaks against it, or it is not known yet.
  [[nodiscard]] std::vector<std::string> findings(std::size_t valve) const;

  static constexpr double judged_s = 30;  ///< by the source's clock

 private:
  struct Place;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live
