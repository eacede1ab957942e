#pragma once
/// Long work beside Python: without the interpreter's lock, and stopped by Ctrl-C.
#include <chrono>
#include <pybind11/pybind11.h>
#include <thread>

namespace spoolflow::python {

/// Thrown through the library where Python has an exception for this thread, which is then raised: KeyboardInterrupt,
/// or that of a callback.
struct Raised {};

/// Asks every now and then whether a signal came. To be called from the work that at_work() does.
class SignalCheck {
 public:
  /// Throws Raised. From another thread than that which works for Python it does nothing: that one asks itself.
  void operator()() {
    if (std::this_thread::get_id() != thread_) return;
    if (raised_) throw Raised();
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(50);
    const pybind11::gil_scoped_acquire lock;
    raise_where(PyErr_CheckSignals() != 0);
  }

  /// The same, and calls `progress`, a function of Python or None, with these values.
  template <class... Values>
  void operator()(const pybind11::object& progress, const Values&... values) {
    (*this)();
    if (std::this_thread::get_id() != thread_ || progress.is_none()) return;
    const pybind11::gil_scoped_acquire lock;
    try {
      progress(values...);
    } catch (pybind11::error_already_set& error) {
      error.restore();
      raise_where(true);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  void raise_where(bool raised) {
    raised_ = raised;
    if (raised) throw Raised();
  }

  std::thread::id thread_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now();
  bool raised_ = false;
};

/// Does `work(check)` without the interpreter's lock.
template <class Work>
auto at_work(const Work& work) {
  SignalCheck check;
  try {
    const pybind11::gil_scoped_release release;
    return work(check);
  } catch (const Raised&) {
    throw pybind11::error_already_set();
  }
}

}  // namespace spoolflow::python
