#pragma once
/// What the command prints for people: names from files and command lines cannot steer the terminal or forge a line.
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/apps/work/harmless_text.hpp"

namespace spoolflow::apps {

/// To standard output. Throws OutputError or ReaderGone where it is refused.
void print_text(std::string_view text);
/// To standard error; where that is refused there is nobody left to report to.
void say_text(std::string_view text);

/// Every text among the values is made harmless; line ends are those of the format alone.
template <class... Values>
void print(fmt::format_string<detail::Harmless<Values>...> format, const Values&... values) {
  print_text(fmt::format(format, detail::harmless(values)...));
}
template <class... Values>
void say(fmt::format_string<detail::Harmless<Values>...> format, const Values&... values) {
  say_text(fmt::format(format, detail::harmless(values)...));
}

/// One line of the program's own.
inline void say_line(const std::string& text) {
  say("spoolflow: {}\n", text);
}

/// A line; nothing where it is empty.
inline void say_note(const std::string& note) {
  if (!note.empty()) say("{}\n", note);
}

/// What was printed counts as written only once it is: `> /dev/full` must not look like success. Throws as
/// print_text().
void flush_standard_output();

/// Takes the descriptors 0 to 2 where the program was started without them (`>&-`): else the next file that it opens
/// would be its standard output. Reading a closed input and writing a closed output still fail; what is said to a
/// closed standard error goes nowhere. First thing in main.
void hold_standard_streams();

}  // namespace spoolflow::apps
