#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>

#include <fmt/format.h>

#include "addons/python/module/bindings.hpp"

namespace spoolflow::python {

void add_errors(pybind11::module_& module) {
  static PyObject* const error = PyErr_NewExceptionWithDoc(
      "spoolflow.Error",
      "Input that cannot be used. The message names file, line or channel, the value, what is allowed and what to do\n"
      "next, in the words of the command line, which then ends with exit status 2.",
      PyExc_ValueError, nullptr);
  module.attr("Error") = pybind11::handle(error);
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const std::invalid_argument& failure) {
      PyErr_SetString(error, failure.what());
    } catch (const std::filesystem::filesystem_error& failure) {  // a name that leads nowhere
      PyErr_SetString(error, fmt::format("{}: {}", failure.path1().string(), failure.code().message()).c_str());
    } catch (const std::bad_alloc&) {
      PyErr_SetString(PyExc_MemoryError, "out of memory; try a shorter recording or a machine with more");
    }
  });
}

}  // namespace spoolflow::python
