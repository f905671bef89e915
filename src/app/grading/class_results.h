// Results of a class that are kept between runs: a file of records, each with the key of what it was made of.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "app/compare/grade.h"

namespace trace {

class ClassResults {
 public:
  /// Reads the file, as far as it is sound. Throws Error(Fault::io) if it is something else.
  explicit ClassResults(std::string file);

  /// Fills in all but the name and file of the pair. False if there is no such record.
  bool find(std::uint64_t key, GradedPair& pair) const;
  void add(std::uint64_t key, const GradedPair& pair);
  /// Writes all records; with `onlyUsed` those that add() or find() named. Does nothing without a file.
  /// Throws Error(Fault::io).
  void save(bool onlyUsed);

 private:
  struct Record {
    std::string bytes;
    mutable bool used = false;
  };
  const std::string file_;
  std::map<std::uint64_t, Record> records_;
};

}  // namespace trace
