#pragma once
/// A small importer: loads an FMU's shared library and drives instances of either version through one interface, as a
/// simulation tool would.
#include <memory>
#include <string>
#include <vector>

#include "tests/fmu/unpacked_fmu.hpp"

namespace spoolflow::exports {

/// What a call came to; numbers as both versions of the standard have them.
enum class FmuStatus { ok = 0, warning = 1, discard = 2, error = 3, fatal = 4 };

/// Log of an importer.
struct FmuLog {
  std::vector<std::string> messages;
};

class FmuInstance {
 public:
  virtual ~FmuInstance() = default;
  /// Start time, then initialization mode.
  virtual FmuStatus enter_initialization(double start_s) = 0;
  virtual FmuStatus exit_initialization() = 0;
  virtual FmuStatus step(double time_s, double step_s) = 0;
  virtual FmuStatus terminate() = 0;
  virtual FmuStatus reset() = 0;
  virtual FmuStatus set_all(const std::vector<unsigned>& references, const std::vector<double>& values) = 0;
  FmuStatus set(unsigned reference, double value) { return set_all({reference}, {value}); }
  virtual FmuStatus set_flag(unsigned reference, bool value) = 0;
  virtual FmuStatus get(unsigned reference, double& value) = 0;
  virtual FmuStatus get_integer(unsigned reference, int& value) = 0;
  /// Through an FMU state and its serialized bytes; empty where a call failed.
  virtual std::vector<char> state() = 0;
  virtual FmuStatus set_state(const std::vector<char>& bytes) = 0;

  // By name, for tests: throws where the call fails.
  void put(const std::string& name, double value);
  double value(const std::string& name);
  int status_bits();
  const UnpackedFmu* fmu = nullptr;
};

/// A loaded shared library; unloaded with the object, after its instances.
class FmuLibrary {
 public:
  explicit FmuLibrary(const UnpackedFmu& fmu) : FmuLibrary(fmu, fmu.library()) {}
  FmuLibrary(const UnpackedFmu& fmu, const std::filesystem::path& library);
  ~FmuLibrary();
  FmuLibrary(const FmuLibrary&) = delete;
  FmuLibrary& operator=(const FmuLibrary&) = delete;

  /// Null where the FMU refuses; the log says why.
  [[nodiscard]] std::unique_ptr<FmuInstance> instantiate(FmuLog& log) const { return instantiate(log, fmu_.token()); }
  [[nodiscard]] std::unique_ptr<FmuInstance> instantiate(FmuLog& log, const std::string& token) const;
  /// Null where the library does not export it.
  [[nodiscard]] void* symbol(const std::string& name) const;

 private:
  const UnpackedFmu& fmu_;
  void* handle_;
};

}  // namespace spoolflow::exports
