// A table of rows that have an id each, in order; and a row that stands in it for a while.
#pragma once

#include <algorithm>
#include <deque>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>

namespace diptych::runner {

template <class Row>
class Registry {
 public:
  /// `what` a row is, in words: "a method".
  Registry(std::initializer_list<Row> rows, const char* what) : rows_(rows), what_(what) {}

  auto begin() const { return rows_.begin(); }
  auto end() const { return rows_.end(); }
  /// Null where there is none.
  const Row* find(const std::string& id) const {
    const auto found = std::find_if(begin(), end(), [&](const Row& row) { return row.id == id; });
    return found == end() ? nullptr : &*found;
  }
  /// Throws std::invalid_argument where a row has this id already.
  void add(Row row) {
    if (find(row.id)) throw std::invalid_argument(std::string("there is ") + what_ + " '" + row.id + "' already");
    rows_.push_back(std::move(row));
  }
  void remove(const std::string& id) {
    std::erase_if(rows_, [&](const Row& row) { return row.id == id; });
  }

 private:
  std::deque<Row> rows_;  ///< a row stays where it is when another one is added
  const char* what_;
};

/// One row more for as long as it lives: how a test, or a program that reads the results of another code, adds one.
/// Not to be made or destroyed while cases are read, running or drawn.
template <class Row, Registry<Row>& (*registry)()>
class Added {
 public:
  /// Throws std::invalid_argument where a row has this id already.
  explicit Added(Row row) : id_(row.id) { registry().add(std::move(row)); }
  ~Added() { registry().remove(id_); }
  Added(const Added&) = delete;
  Added& operator=(const Added&) = delete;

 private:
  std::string id_;
};

}  // namespace diptych::runner
