#include "addons/live/notify/delivery.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <curl/curl.h>
#include <memory>
#include <mutex>
#include <random>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace spoolflow::live {
namespace {

constexpr long connect_patience_s = 10, patience_s = 30;

struct List {
  curl_slist* head = nullptr;

  List() = default;
  ~List() { curl_slist_free_all(head); }
  List(const List&) = delete;
  List& operator=(const List&) = delete;
  void add(const std::string& line) { head = curl_slist_append(head, line.c_str()); }
};

using Handle = std::unique_ptr<CURL, decltype(&curl_easy_cleanup)>;

/// What is left of a mail to be read.
struct Upload {
  std::string_view rest;
};

std::size_t read_upload(char* to, std::size_t size, std::size_t count, void* from) {
  auto& upload = *static_cast<Upload*>(from);
  const std::size_t taken = std::min(size * count, upload.rest.size());
  std::copy_n(upload.rest.begin(), taken, to);
  upload.rest.remove_prefix(taken);
  return taken;
}

std::size_t ignore(char*, std::size_t size, std::size_t count, void*) {
  return size * count;
}

int gives_up(void* stop, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
  return static_cast<const std::stop_token*>(stop)->stop_requested() ? 1 : 0;
}

/// RFC 5322, with the subject as an encoded word (RFC 2047) where it is no ASCII, and lines that end with CR LF.
std::string mail_of(const NotifySettings& to, const NotifyMessage& message) {
  std::string subject;
  for (const char c : message.subject) {
    const bool plain = c >= ' ' && c < 0x7f;
    if (plain) subject += c;
    if (!plain && (static_cast<unsigned char>(c) & 0xC0U) != 0x80U) subject += "...";  // the dots of a cut list
  }
  std::random_device random;
  const std::time_t now = std::time(nullptr);
  std::string out = fmt::format(
      "Date: {:%a, %d %b %Y %H:%M:%S} +0000\nFrom: <{}>\nTo: <{}>\nSubject: {}\nMessage-ID: <{}.{:08x}{:08x}@{}>\n"
      "Auto-Submitted: auto-generated\nMIME-Version: 1.0\nContent-Type: text/plain; charset=utf-8\n"
      "Content-Transfer-Encoding: 8bit\n\n{}",
      fmt::gmtime(now), to.from, fmt::join(to.to, ">, <"), subject, now, random(), random(),
      to.from.substr(to.from.find('@') + 1), message.text);
  for (std::size_t at = out.find('\n'); at != std::string::npos; at = out.find('\n', at + 2)) out.insert(at, 1, '\r');
  return out;
}

/// An error's text may quote what was sent.
std::string without_secrets(std::string text, const NotifySettings& to) {
  for (const std::string& secret : {to.is_mail() ? std::string() : to.url, to.token, to.password}) {
    for (std::size_t at = 0; !secret.empty() && (at = text.find(secret, at)) != std::string::npos;) {
      text.replace(at, secret.size(), "…");
    }
  }
  return text;
}

}  // namespace

std::string deliver(const NotifySettings& to, const NotifyMessage& message, const std::stop_token& stop) {
  static std::once_flag once;
  std::call_once(once, [] { curl_global_init(CURL_GLOBAL_DEFAULT); });
  const Handle handle(curl_easy_init(), &curl_easy_cleanup);
  CURL* const curl = handle.get();
  if (curl == nullptr) return "libcurl does not begin";
  std::array<char, CURL_ERROR_SIZE> reason{};
  List headers, recipients;
  const std::string mail = to.is_mail() ? mail_of(to, message) : std::string();
  Upload upload{mail};
  curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, reason.data());
  curl_easy_setopt(curl, CURLOPT_URL, to.url.c_str());
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, connect_patience_s);
  curl_easy_setopt(curl, CURLOPT_TIMEOUT, patience_s);
  curl_easy_setopt(curl, CURLOPT_SSLVERSION, long{CURL_SSLVERSION_TLSv1_2});
  curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, &ignore);
  curl_easy_setopt(curl, CURLOPT_NOPROGRESS, 0L);
  curl_easy_setopt(curl, CURLOPT_XFERINFOFUNCTION, &gives_up);
  curl_easy_setopt(curl, CURLOPT_XFERINFODATA, &stop);
  if (!to.authority.empty()) curl_easy_setopt(curl, CURLOPT_CAINFO, to.authority.c_str());
  if (to.is_mail()) {
    if (to.encrypted) curl_easy_setopt(curl, CURLOPT_USE_SSL, long{CURLUSESSL_ALL});
    if (!to.user.empty()) {
      curl_easy_setopt(curl, CURLOPT_USERNAME, to.user.c_str());
      curl_easy_setopt(curl, CURLOPT_PASSWORD, to.password.c_str());
    }
    for (const std::string& one : to.to) recipients.add("<" + one + ">");
    const std::string sender = "<" + to.from + ">";
    curl_easy_setopt(curl, CURLOPT_MAIL_FROM, sender.c_str());
    curl_easy_setopt(curl, CURLOPT_MAIL_RCPT, recipients.head);
    curl_easy_setopt(curl, CURLOPT_READFUNCTION, &read_upload);
    curl_easy_setopt(curl, CURLOPT_READDATA, &upload);
    curl_easy_setopt(curl, CURLOPT_UPLOAD, 1L);
  } else {
    headers.add("Content-Type: application/json");
    headers.add("Expect:");
    if (!to.token.empty()) headers.add("Authorization: Bearer " + to.token);
    curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers.head);
    curl_easy_setopt(curl, CURLOPT_USERAGENT, "spoolflow");
    curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE, static_cast<long>(message.json.size()));
    curl_easy_setopt(curl, CURLOPT_POSTFIELDS, message.json.c_str());
  }
  const CURLcode done = curl_easy_perform(curl);
  if (done != CURLE_OK) {
    return without_secrets(reason.front() != 0 ? reason.data() : curl_easy_strerror(done), to);
  }
  long status = 0;
  curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &status);
  const bool accepted = to.is_mail() || (status >= 200 && status < 300);
  return accepted ? std::string() : fmt::format("it answers with status {}", status);
}

}  // namespace spoolflow::live
