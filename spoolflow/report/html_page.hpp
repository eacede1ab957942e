#pragma once
/// One self-contained page: style sheet inside, no script, no network.
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::report {

class HtmlPage {
 public:
  explicit HtmlPage(std::string title) : title_(std::move(title)) {}

  void heading(std::string_view text);  ///< a section; it appears in the contents
  void subheading(std::string_view text);
  void paragraph(std::string_view text);
  void html(std::string_view markup) { body_ += markup; }
  /// A figure with its caption; `markup` is from svg_of.
  void figure(std::string_view markup, std::string_view caption);
  /// Rows of equal length; the first column is text, the others are set right.
  void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);
  [[nodiscard]] std::string str() const;

 private:
  std::string title_;
  std::string body_;
  std::string contents_;
  int sections_ = 0;
  int figures_ = 0;
};

}  // namespace spoolflow::report
