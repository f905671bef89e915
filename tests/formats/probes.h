// Probes of formats: for each row of the table of known fields (formats/known_fields.h) a file with the field
// and one without it. What the row says must become of it is what the reader does.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "formats/known_fields.h"

namespace trace {

struct Probe {
  std::string field;          ///< as in the table
  std::string without, with;  ///< the files
  std::string told{};         ///< a part of the warning or error about the field
  std::string same{};         ///< a file that must look the same as the one with the field, if not empty
};

/// What reading a file came to.
struct Outcome {
  std::string seen;               ///< all that a picture of it depends on
  std::vector<std::string> told;  ///< warnings
  std::vector<int> lines;         ///< where they are
  std::optional<std::string> error{};
};

/// Holds each probe against its row, and the rows against the probes. `read(bytes)` gives an Outcome.
template <class Read>
void expectProbes(std::span<const KnownField> rows, const std::vector<Probe>& probes, bool hasLines,
                  const Read& read) {
  std::set<std::string> probed;
  for (const Probe& probe : probes) {
    SCOPED_TRACE("the field " + probe.field);
    EXPECT_TRUE(probed.insert(probe.field).second) << "two probes";
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const KnownField& known) { return known.field == probe.field; });
    if (row == rows.end()) {
      ADD_FAILURE() << "no row in the table";
      continue;
    }
    const Outcome without = read(probe.without), with = read(probe.with);
    EXPECT_FALSE(without.error) << without.error.value_or("");
    std::vector<std::string> fresh;
    std::vector<int> lines;
    for (std::size_t i = 0; i < with.told.size(); ++i)
      if (std::find(without.told.begin(), without.told.end(), with.told[i]) == without.told.end()) {
        fresh.push_back(with.told[i]);
        lines.push_back(with.lines[i]);
      }
    std::string all;
    for (const std::string& one : fresh) all += one + "\n";
    using Fate = KnownField::Fate;
    if (row->fate == Fate::refused) {
      ASSERT_FALSE(probe.told.empty());
      EXPECT_TRUE(with.error && with.error->find(probe.told) != std::string::npos)
          << with.error.value_or("it is read") << "\n"
          << all;
      continue;
    }
    EXPECT_FALSE(with.error) << with.error.value_or("");
    if (row->fate == Fate::shown) {
      EXPECT_NE(with.seen, without.seen) << "it is not shown\n" << all;
      EXPECT_EQ(all.find("not shown"), std::string::npos) << all;
      if (!probe.same.empty()) {
        EXPECT_EQ(with.seen, read(probe.same).seen);
      }
    } else if (row->fate == Fate::idle) {
      EXPECT_EQ(with.seen, without.seen);
      EXPECT_EQ(all, "");
    } else {
      ASSERT_FALSE(probe.told.empty());
      EXPECT_EQ(fresh.size(), 1u) << all;
      EXPECT_NE(all.find(probe.told), std::string::npos) << "told: " << all;
      if (hasLines && !lines.empty()) {
        EXPECT_GT(lines.front(), 0) << all;
      }
    }
  }
  for (const KnownField& row : rows)
    EXPECT_TRUE(probed.contains(std::string(row.field))) << "no probe of the field " << row.field;
}

}  // namespace trace
