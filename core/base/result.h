// SPDX-License-Identifier: MIT
// Errors are values: what is wrong, where (file, node or joint), and what to do about it.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace elbowroom {

struct Error {
  std::string what;    // what is wrong, one sentence
  std::string where;   // file, and in it the node, joint or JSON pointer
  std::string remedy;  // what the user can do; may be empty

  // "where: what. remedy" on one line.
  std::string message() const {
    std::string text = where.empty() ? what : where + ": " + what;
    if (!remedy.empty()) text += " (" + remedy + ")";
    return text;
  }
};

// Either a value or an Error. value() requires ok(), error() requires !ok().
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : data_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : data_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return data_.index() == 0; }
  explicit operator bool() const { return ok(); }
  T& value() & { return std::get<0>(data_); }
  const T& value() const& { return std::get<0>(data_); }
  T&& value() && { return std::get<0>(std::move(data_)); }
  const Error& error() const { return std::get<1>(data_); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }

 private:
  std::variant<T, Error> data_;
};

struct Done {};
using Status = Result<Done>;

}  // namespace elbowroom
