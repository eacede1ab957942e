#pragma once
/// The subjects of NATS by which sites and workers speak. A site may publish blocks and models of its own name, and
/// read what is addressed to it, and nothing else.
#include <cstdint>
#include <string>

namespace spoolflow::fleet {

/// Blocks: spoolflow.block.PARTITION.SITE
inline std::string block_subject(std::int64_t partition, const std::string& site) {
  return "spoolflow.block." + std::to_string(partition) + "." + site;
}
/// Model files, when they were asked for: spoolflow.model.SITE, the hash in 64 digits and then the packed file.
inline std::string model_subject(const std::string& site) {
  return "spoolflow.model." + site;
}
/// What is committed: lines "ID SESSION NUMBER", all blocks of the valve up to that one.
inline std::string coverage_subject(const std::string& site) {
  return "spoolflow.coverage." + site;
}
/// What workers miss: "blocks ID NUMBER", from that one on, or "model SHA256".
inline std::string ask_subject(const std::string& site) {
  return "spoolflow.ask." + site;
}
/// The site of a valve "SITE/ID", and what it calls it.
inline std::string site_of(const std::string& valve) {
  return valve.substr(0, valve.find('/'));
}
inline std::string id_of(const std::string& valve) {
  return valve.substr(valve.find('/') + 1);
}

}  // namespace spoolflow::fleet
