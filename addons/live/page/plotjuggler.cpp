#include "addons/live/page/plotjuggler.hpp"

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <fmt/format.h>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::live {
namespace {

namespace asio = boost::asio;
using asio::ip::udp;

constexpr auto sending_period = std::chrono::milliseconds(25);

}  // namespace

std::string plotjuggler_message(const std::string& valve, const PlotPoint& point, monitor::Ne107 condition,
                                double timestamp_s) {
  constexpr auto flow = units::litre_per_minute_per_m3_per_s;
  std::string out = fmt::format("{{\"timestamp\":{:.6f},\"{}\":{{\"time_s\":{:.6f}", timestamp_s, valve, point.time_s);
  const auto put = [&](const char* name, double value) {
    if (std::isfinite(value)) out += fmt::format(",\"{}\":{:.7g}", name, value);
  };
  put("flow_min_L_min", flow * double{point.flow_min_m3_per_s});
  put("flow_max_L_min", flow * double{point.flow_max_m3_per_s});
  put("flow_lower_L_min", flow * double{point.lower_min_m3_per_s});
  put("flow_upper_L_min", flow * double{point.upper_max_m3_per_s});
  put("position_mm", 1e3 * double{point.position_m});
  put("current_A", double{point.current_A});
  return out + fmt::format(",\"status\":{},\"ne107\":{}}}}}", point.status, static_cast<int>(condition));
}

struct PlotJuggler::Parts {
  /// From the valve's clock to the time of day; it stays as it is, so that plots have no jitter, until it is plainly
  /// off.
  struct Clock {
    static constexpr double most_off_s = 1;
    bool known = false;
    double offset_s = 0;
    std::uint64_t next = 0;  ///< number of the first point that was not sent
    monitor::Ne107 condition = monitor::Ne107::good;

    void follow(double offset_now_s) {
      if (known && std::abs(offset_now_s - offset_s) < most_off_s) return;
      known = true;
      offset_s = offset_now_s;
    }
  };

  const Engine& engine;
  asio::io_context context{};
  udp::socket socket{context};
  std::vector<Clock> clocks{};
  std::jthread thread{};

  explicit Parts(const Engine& of) : engine(of), clocks(of.size()) {}

  void send(std::size_t k) {
    Clock& clock = clocks[k];
    const ValveAtWork::TracePart part = engine.valve(k).trace_from(clock.next);
    if (part.points.size() < 2) return;  // the last may still grow
    const double age_s = 1e-9 * static_cast<double>(steady_ns() - part.arrived_ns);
    clock.follow(1e-3 * static_cast<double>(wall_ms()) - age_s - part.points.back().time_s);
    for (std::size_t p = 0; p + 1 < part.points.size(); ++p) {
      const PlotPoint& point = part.points[p];
      const std::string text =
          plotjuggler_message(engine.valve(k).id(), point, clock.condition, clock.offset_s + point.time_s);
      boost::system::error_code nobody_listens;
      socket.send(asio::buffer(text), 0, nobody_listens);
    }
    clock.next = part.first + part.points.size() - 1;
  }
  void run(const std::stop_token& stop) {
    constexpr int rounds_a_second = 40;
    for (int round = 0; !stop.stop_requested(); ++round) {
      for (std::size_t k = 0; k < clocks.size(); ++k) {
        if (round % rounds_a_second == 0) clocks[k].condition = engine.view(k).condition;
        send(k);
      }
      std::this_thread::sleep_for(sending_period);
    }
  }
};

PlotJuggler::PlotJuggler(const Engine& engine, const Address& to) : parts_(std::make_unique<Parts>(engine)) {
  boost::system::error_code error;
  const udp::endpoint endpoint(asio::ip::make_address(to.host, error), to.port);
  if (!error) parts_->socket.open(endpoint.protocol(), error);
  if (!error) parts_->socket.connect(endpoint, error);
  if (!error) parts_->socket.non_blocking(true, error);
  if (error) {
    throw SiteError(fmt::format("[plotjuggler]: nothing can be sent to {} ({}); name an address such as 127.0.0.1:9870",
                                to.text(), error.message()));
  }
  parts_->thread = std::jthread([parts = parts_.get()](const std::stop_token& stop) { parts->run(stop); });
}

PlotJuggler::~PlotJuggler() = default;

}  // namespace spoolflow::live
