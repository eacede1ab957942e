#include "spoolflow/recording/mdf4/mdf4_table.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "spoolflow/recording/mdf4/mdf4_walk.hpp"

namespace spoolflow::recording {
namespace {

class Mdf4Table final : public VectorTable {
 public:
  explicit Mdf4Table(const std::filesystem::path& path)
      : VectorTable(path.string()), bytes_(path), contents_(read_mdf4_contents(bytes_)) {
    std::set<std::string> names;
    for (std::size_t g = 0; g < contents_.groups.size(); ++g) {
      if (contents_.time_group[g] != g) continue;
      std::string& name = contents_.groups[g].name;
      if (!names.insert(name).second) names.insert(name = fmt::format("{} #{}", name, g + 1));
    }
    for (std::size_t g = 0; g < contents_.groups.size(); ++g) {
      const Mdf4Group& group = contents_.groups[g];
      const std::string& timed = contents_.groups[contents_.time_group[g]].name;
      for (std::size_t c = 0; c < group.channels.size(); ++c) {
        const Mdf4Channel& channel = group.channels[c];
        FileColumn column{names.size() == 1 ? channel.name : timed + "/" + channel.name,
                          channel.is_time ? "time" : channel.name, channel.unit};
        add({std::move(column), group.count});
        sources_.push_back({g, c});
      }
    }
  }

  [[nodiscard]] std::vector<UnreadPart> unread() const override { return contents_.unread; }

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    if (first != first_ || count != count_) fill(first, count);
    std::ranges::copy(window_.at(column), out);
  }

 protected:
  void chosen(const std::vector<std::size_t>& columns) override {
    for (const std::size_t column : columns) {
      window_[column];
      const std::size_t group = sources_[column].group;
      walks_.try_emplace(group, contents_.groups[group]);
    }
  }

 private:
  struct Source {
    std::size_t group, channel;
  };

  [[nodiscard]] const Mdf4Channel& channel(std::size_t column) const {
    return contents_.groups[sources_[column].group].channels[sources_[column].channel];
  }

  /// Reads those samples of all chosen columns, each record once.
  void fill(std::uint64_t first, std::size_t count) {
    first_ = first, count_ = 0;  // nothing, should the reading fail
    for (auto& [group, walk] : walks_) {
      std::vector<std::pair<const Mdf4Sample*, double*>> wanted;
      for (auto& [column, values] : window_) {
        if (sources_[column].group != group) continue;
        values.resize(count);
        wanted.emplace_back(&channel(column).sample, values.data());
      }
      walk.show(first, count, [&](const std::uint8_t* record, std::uint64_t index) {
        for (const auto& [sample, out] : wanted) out[index - first] = sample->read(record, index);
      });
    }
    for (auto& [column, values] : window_) {
      const bool whole = channel(column).sample.number.kind != StoredNumber::Kind::real;
      channel(column).conversion.apply(values.data(), values.size(), whole);
    }
    count_ = count;
  }

  FileBytes bytes_;
  Mdf4Contents contents_;
  std::vector<Source> sources_;                        ///< one a column
  std::map<std::size_t, Mdf4Walk> walks_;              ///< of the groups of the chosen columns
  std::map<std::size_t, std::vector<double>> window_;  ///< the samples at hand of each chosen column
  std::uint64_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<VectorTable> open_mdf4_table(const std::filesystem::path& file) {
  return std::make_unique<Mdf4Table>(file);
}

}  // namespace spoolflow::recording
