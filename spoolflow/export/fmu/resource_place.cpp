#include "spoolflow/export/fmu/resource_place.hpp"

namespace spoolflow::exports::fmu {
namespace {

int hexadecimal(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

bool is_drive(std::string_view path) {
  return path.size() > 2 && path[0] == '/' && path[2] == ':';
}

}  // namespace

std::string folder_of_uri(std::string_view uri) {
  const std::string_view scheme = "file:";
  if (!uri.starts_with(scheme)) return uri.find("://") == std::string_view::npos ? std::string(uri) : std::string();
  uri.remove_prefix(scheme.size());
  if (uri.starts_with("//")) {  // an authority: empty, localhost, or a server
    uri.remove_prefix(2);
    if (uri.starts_with("localhost/")) uri.remove_prefix(9);
    if (!uri.starts_with("/") && uri.find('/') != std::string_view::npos && !(uri.size() > 1 && uri[1] == ':')) {
      return "//" + folder_of_uri(std::string("file:") + std::string(uri));
    }
  }
  std::string path;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    if (uri[k] != '%') {
      path += uri[k];
      continue;
    }
    const int high = k + 2 < uri.size() ? hexadecimal(uri[k + 1]) : -1;
    const int low = high >= 0 ? hexadecimal(uri[k + 2]) : -1;
    if (low < 0) return {};
    path += static_cast<char>(high * 16 + low);
    k += 2;
  }
  return is_drive(path) ? path.substr(1) : path;
}

}  // namespace spoolflow::exports::fmu
