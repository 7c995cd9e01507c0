// SPDX-License-Identifier: MIT
#include "core/io/json_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/io/gltf_container.h"

namespace elbowroom {
namespace {

namespace jt = json_text;

TEST(JsonText, FindsMembersAndElements) {
  const std::string text =
      "\xEF\xBB\xBF { \"a\" : [1 , {\"x\":\"],}\\\"\"}, [] , \"s\"] ,\"b\":{},\"\\u0061\":-1e-5 } ";
  ASSERT_TRUE(jt::is_json(text));
  const jt::Span root = jt::root(text);
  const auto members = jt::members(text, root);
  ASSERT_EQ(members.size(), 3u);
  EXPECT_EQ(members[2].key, "a");
  EXPECT_EQ(jt::view(text, *jt::find(text, root, "a")), "-1e-5");  // the last one counts
  const auto elements = jt::elements(text, members[0].value);
  ASSERT_EQ(elements.size(), 4u);
  EXPECT_EQ(jt::view(text, elements[1]), "{\"x\":\"],}\\\"\"}");
  EXPECT_EQ(jt::view(text, elements[2]), "[]");
  EXPECT_FALSE(jt::find(text, root, "c"));
  EXPECT_TRUE(jt::members(text, elements[2]).empty());
  EXPECT_EQ(jt::all_members(text).size(), 4u);
}

TEST(JsonText, PatchesAndLeavesTheRest) {
  const std::string text = "{ \"n\" : 1.0 , \"list\":[ 20000000000000000000 ], \"empty\" : [ ] }";
  jt::Patch patch(text);
  const jt::Span root = jt::root(text);
  patch.set_member(root, "new", "1");
  patch.set_member(root, "newer", "2");
  patch.set_member(root, "n", "1e2");
  patch.append(*jt::find(text, root, "list"), {"2", "3"});
  patch.append(*jt::find(text, root, "empty"), {"4", "5"});
  EXPECT_EQ(patch.apply(),
            "{ \"n\" : 1e2 , \"list\":[ 20000000000000000000,2,3 ], \"empty\" : [4,5 ],\"new\":1,"
            "\"newer\":2 }");
  const std::string none = "{ }";
  jt::Patch fill(none);
  fill.set_member(jt::root(none), "a", "1");
  fill.set_member(jt::root(none), "b", "2");
  EXPECT_EQ(fill.apply(), "{\"a\":1,\"b\":2 }");
}

TEST(JsonText, RemovesMembersWhereverTheyStand) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::string text = "{ ";
    nlohmann::json expected = nlohmann::json::object();
    const int count = static_cast<int>(random.below(6));
    for (int i = 0; i < count; ++i) {
      const bool gone = random.below(2) == 0;
      const std::string key = gone ? "x" : "k" + std::to_string(i);
      text += (i ? " , " : "") + ("\"" + key + "\" : " + std::to_string(i));
      if (!gone) expected[key] = i;
    }
    text += " }";
    jt::Patch patch(text);
    patch.remove_member(jt::root(text), "x");
    const auto parsed = nlohmann::json::parse(patch.apply(), nullptr, false);
    EXPECT_EQ(parsed, expected) << text << " became " << patch.apply();
  }
}

TEST(JsonText, BearsDeepNestingAndOddBytes) {
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  ASSERT_TRUE(jt::is_json(deep));
  EXPECT_EQ(jt::root(deep).end, deep.size());
  EXPECT_TRUE(jt::all_members(deep).empty());
  EXPECT_EQ(jt::quoted("a\"\n"), "\"a\\\"\\n\"");
  EXPECT_TRUE(jt::is_json(jt::quoted("\xFF\xFE")));
  EXPECT_FALSE(jt::is_json("{"));
  EXPECT_FALSE(jt::is_json(""));
}

TEST(Uris, AreTakenApart) {
  using namespace gltf_export;
  EXPECT_TRUE(is_relative_uri("a b.png"));
  EXPECT_TRUE(is_relative_uri("tex/a%20b.png"));
  EXPECT_TRUE(is_relative_uri("a/b:c"));
  for (const char* uri : {"", "/etc/passwd", "http://x/y", "data:,x", "file:x"}) {
    EXPECT_FALSE(is_relative_uri(uri)) << uri;
  }
  EXPECT_EQ(percent_decoded("a%20b%2"), "a b%2");
  EXPECT_EQ(percent_decoded(percent_encoded("ä b%#?.png")), "ä b%#?.png");
  Random random(2);
  for (int length = 0; length < 50; ++length) {
    std::string bytes;
    for (int i = 0; i < length; ++i) bytes += static_cast<char>(random.below(256));
    const auto data = decode_data_uri(encode_data_uri("image/png", bytes));
    ASSERT_TRUE(data);
    EXPECT_EQ(data->bytes, bytes);
    EXPECT_EQ(data->mime, "image/png");
  }
  EXPECT_EQ(decode_data_uri("data:,a%20b")->bytes, "a b");
  EXPECT_FALSE(decode_data_uri("data:;base64,a!b="));
  EXPECT_FALSE(decode_data_uri("data:;base64"));
}

TEST(Containers, ComeApartAndTogether) {
  using namespace gltf_export;
  Container container;
  container.binary = true;
  container.json = "{\"asset\":{}}";
  container.bin = "12345678";
  container.other_chunks = std::string("\x04\0\0\0abcdwxyz", 12);
  const auto bytes = write_container(container, "x.glb");
  ASSERT_TRUE(bytes.ok());
  const auto again = parse_container(*bytes, "x.glb");
  ASSERT_TRUE(again.ok()) << again.error().message();
  EXPECT_EQ(again->json, container.json);
  EXPECT_EQ(again->bin, container.bin);
  EXPECT_EQ(again->other_chunks, container.other_chunks);
  // Every shortened or damaged form is refused or read, never a crash.
  for (std::size_t length = 0; length < bytes->size(); ++length) {
    EXPECT_FALSE(parse_container(bytes->substr(0, length), "x.glb").ok());
  }
  for (std::size_t i = 0; i < bytes->size(); ++i) {
    for (const char with : {'\0', '\x7F', '\xFF'}) {
      std::string damaged = *bytes;
      damaged[i] = with;
      const auto result = parse_container(damaged, "x.glb");
      if (!result.ok()) {
        EXPECT_FALSE(result.error().message().empty());
      }
    }
  }
}

}  // namespace
}  // namespace elbowroom
