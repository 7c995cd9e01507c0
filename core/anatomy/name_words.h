// SPDX-License-Identifier: MIT
// The words that joints' names are made of, and what they mean.
//
// Pure functions, any thread. Names are UTF-8.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace elbowroom {

enum class NameWord {
  side_left,
  side_right,
  part,  // of an arm or leg, or a word that tells which part: "upper"
  finger,
  toe,
  helper,      // says that the joint is no limb joint of its own: "twist", "target", "sleeve"
  copy,        // "org"
  end_marker,  // "end", "nub"
  noise,       // says nothing: "joint", "def"
};

// English words, lower case.
const std::map<std::string, NameWord, std::less<>>& name_words();

// Words of other languages in Latin letters, lower case and without accents, with the English ones
// (separated by spaces) that they mean.
const std::map<std::string, std::string, std::less<>>& translated_words();

// A name as its artist wrote it, in words that we know: %2E, FBXASC046 and the like are characters
// again, accents are dropped, and Japanese, Chinese, Korean and Russian words are English ones
// between spaces.
std::string plain_name(const std::string& text);

}  // namespace elbowroom
