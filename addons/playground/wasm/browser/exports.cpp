// What the page's worker calls: a request and its answer as text in the program's memory.
#include <emscripten.h>
#include <fstream>
#include <memory>
#include <string>

#include "addons/playground/requests/playground.hpp"

EM_JS(void, spoolflow_progress, (double share, const char* step), { Module.progress(share, UTF8ToString(step)); });

extern "C" EMSCRIPTEN_KEEPALIVE const char* spoolflow_answer(const char* request) {
  static spoolflow::playground::Playground playground(
      {.progress = [](double share, std::string_view step) { spoolflow_progress(share, std::string(step).c_str()); },
       .opened = [](const std::string& file) -> std::unique_ptr<std::ostream> {
         auto out = std::make_unique<std::ofstream>(file, std::ios::binary);
         if (!*out) return nullptr;
         return out;
       }});
  static std::string answer;
  answer = playground.answer(request);
  return answer.c_str();
}
