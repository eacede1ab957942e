#pragma once
/// CAN frames as files and datagrams of other programs hold them: candump's log, Vector's ASC, python-can's UDP
/// multicast (MessagePack). Times in seconds since 1970.
#include <optional>
#include <string>
#include <string_view>

#include "spoolflow/sensor/fieldbus/can_answer.hpp"

namespace spoolflow::fieldbus {

/// "(1700000000.123456) can0 0CFE1080#7DFFF0FFFFFFFFFF\n"
[[nodiscard]] std::string candump_line(const sensor::CanFrame& frame, double time_s, std::string_view interface);

/// The lines before the first frame of an ASC file; its times count from `start_s`, in UTC.
[[nodiscard]] std::string asc_beginning(double start_s);
[[nodiscard]] std::string asc_line(const sensor::CanFrame& frame, double since_start_s);

/// A map as python-can 4 sends one per datagram.
[[nodiscard]] std::string can_datagram(const sensor::CanFrame& frame, double time_s);
/// Nothing where the bytes are no classical data frame of that form.
[[nodiscard]] std::optional<sensor::CanFrame> read_can_datagram(std::string_view bytes);

}  // namespace spoolflow::fieldbus
