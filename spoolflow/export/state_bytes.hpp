#pragma once
/// A state as bytes that a file or another process may keep: a header that names their owner, the state as it lies in
/// memory, and a checksum. They serve the same version of the library on the same kind of machine.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "spoolflow/numerics/checksum.hpp"

namespace spoolflow::exports {

/// Bytes that cannot become a state again; the message says why.
struct StateError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Whom a state belongs to.
struct StateOwner {
  std::uint64_t model;  ///< checksum of the model
  std::uint32_t kind;   ///< estimator or component
};

struct StateHeader {
  char magic[8];
  std::uint32_t state_size;
  std::uint32_t kind;
  std::uint64_t model;
  std::uint64_t checksum;  ///< of the state's bytes
};

inline constexpr char state_magic[8] = {'s', 'p', 'o', 'o', 'l', 's', 't', '1'};

/// Bytes of a state of `state_size` bytes.
constexpr std::size_t packed_size(std::size_t state_size) {
  return sizeof(StateHeader) + state_size;
}

/// Writes packed_size(state_size) bytes to `out`.
inline void pack_state(const StateOwner& owner, const void* state, std::size_t state_size, char* out) {
  StateHeader header{};
  std::memcpy(header.magic, state_magic, sizeof state_magic);
  header.state_size = static_cast<std::uint32_t>(state_size);
  header.kind = owner.kind;
  header.model = owner.model;
  std::memcpy(out + sizeof header, state, state_size);
  header.checksum = numerics::checksum(out + sizeof header, state_size);
  std::memcpy(out, &header, sizeof header);
}

/// Reads what pack_state wrote; `state` is untouched where it throws StateError.
inline void unpack_state(const StateOwner& owner, const char* bytes, std::size_t size, void* state,
                         std::size_t state_size) {
  StateHeader header{};
  if (size < sizeof header) throw StateError("these bytes are no state: too few");
  std::memcpy(&header, bytes, sizeof header);
  if (std::memcmp(header.magic, state_magic, sizeof state_magic) != 0) throw StateError("these bytes are no state");
  if (header.state_size != state_size) {
    throw StateError("the state was kept by another version of the library: start afresh, or use that version");
  }
  if (size != packed_size(state_size)) throw StateError("the state's bytes are not all there");
  if (header.kind != owner.kind) throw StateError("the state belongs to another estimator");
  if (header.model != owner.model) throw StateError("the state belongs to another model");
  if (header.checksum != numerics::checksum(bytes + sizeof header, state_size)) {
    throw StateError("the state's bytes are damaged: their checksum does not hold");
  }
  std::memcpy(state, bytes + sizeof header, state_size);
}

}  // namespace spoolflow::exports
