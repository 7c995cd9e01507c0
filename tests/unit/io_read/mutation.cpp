// SPDX-License-Identifier: MIT
#include "tests/unit/io_read/mutation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <iterator>

#include "core/base/random.h"
#include "core/io/gltf_reader.h"
#include "tests/unit/io_read/gltf_maker.h"
#include "tests/unit/io_read/model_checks.h"
#include "tests/unit/io_read/sample_index.h"

namespace elbowroom::test {
namespace {

// Starts of runs of digits, so that numbers in JSON are hit often enough.
std::vector<std::size_t> numbers_in(const std::string& bytes) {
  std::vector<std::size_t> at;
  const std::size_t end = std::min<std::size_t>(bytes.size(), 1 << 16);
  for (std::size_t i = 1; i < end; ++i) {
    const bool digit = bytes[i] >= '0' && bytes[i] <= '9';
    const bool after_sign = bytes[i - 1] == ':' || bytes[i - 1] == ',' || bytes[i - 1] == '[';
    if (digit && after_sign) at.push_back(i);
  }
  return at;
}

// Where the bytes of a GLB begin that are no JSON; 0 in other files.
std::size_t binary_start(const std::string& bytes) {
  const std::size_t at = bytes.find(std::string("BIN\0", 4));
  return at == std::string::npos ? 0 : at + 4;
}

// Anything, anywhere: mostly refused early.
void mutate_roughly(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  const std::size_t at = random.below(bytes.size());
  const std::size_t length = 1 + random.below(std::min<std::size_t>(bytes.size() - at, 64));
  switch (random.below(5)) {
    case 0:
      bytes[at] = static_cast<char>(random.below(256));
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.insert(random.below(bytes.size()), bytes.substr(at, length));
      break;
    default:
      bytes.resize(at);
  }
}

// A 32-bit word of the data, where floats, indices and weights are.
void mutate_word(std::string& bytes, std::size_t begin, Random& random) {
  static constexpr std::array<std::uint32_t, 8> kWords{
      0, 1, 0xffffffff, 0x7fffffff, 0x80000000, 0x7fc00000, 0x7f800000, 0xffff};
  if (begin >= bytes.size()) return;
  const std::size_t at = begin + random.below(bytes.size() - begin) / 4 * 4;
  const std::uint32_t word = kWords[random.below(kWords.size())];
  for (std::size_t k = 0; k < 4 && at + k < bytes.size(); ++k) {
    bytes[at + k] = static_cast<char>(word >> (8 * k) & 0xff);
  }
}

// A number in the JSON, with as many digits, so that all else stays in place.
void mutate_number(std::string& bytes, const std::vector<std::size_t>& numbers, Random& random) {
  if (numbers.empty()) return;
  static constexpr std::array<char, 12> kDigits{'0', '1', '2', '3', '4', '9',
                                                '-', 'e', '.', '5', '7', '8'};
  for (std::size_t at = numbers[random.below(numbers.size())];
       at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; ++at) {
    bytes[at] = kDigits[random.below(random.below(8) == 0 ? kDigits.size() : 6)];
  }
}

}  // namespace

std::string mutated(const std::string& bytes, std::uint64_t seed) {
  Random random(seed);
  std::string out = bytes;
  const std::vector<std::size_t> numbers = numbers_in(bytes);
  const std::size_t binary = binary_start(bytes);
  const std::uint64_t count = 1 + random.below(4);
  const bool rough = random.below(4) == 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (rough) {
      mutate_roughly(out, random);
    } else if (random.below(2) == 0 && binary > 0) {
      mutate_word(out, binary, random);
    } else {
      mutate_number(out, numbers, random);
    }
  }
  return out;
}

FuzzReport fuzz_reader(const std::vector<std::string>& files, int count, std::uint64_t seed) {
  FuzzReport report;
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "fuzz.glb";
  const std::string inside = std::filesystem::canonical(folder.path()).string() + "/";
  for (std::size_t f = 0; f < files.size(); ++f) {
    for (int i = 0; i < count; ++i) {
      const std::uint64_t this_seed = seed + 1000003 * f + static_cast<std::uint64_t>(i);
      SCOPED_TRACE("file " + std::to_string(f) + ", seed " + std::to_string(this_seed));
      write_file(path, mutated(files[f], this_seed));
      ReadOptions options;
      options.on_open = [&](const std::filesystem::path& opened) {
        EXPECT_EQ(std::filesystem::canonical(opened).string().rfind(inside, 0), 0u) << opened;
      };
      const auto begin = std::chrono::steady_clock::now();
      const auto model = read_gltf(path, options);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      report.slowest = std::max(report.slowest, took.count());
      EXPECT_LT(took.count(), 5.0);
      ++report.read;
      if (model.ok()) {
        ++report.opened;
        expect_sound(**model);
      } else {
        EXPECT_FALSE(model.error().message().empty());
      }
      if (testing::Test::HasFatalFailure()) return report;
    }
  }
  return report;
}

std::vector<std::string> small_samples(const std::filesystem::path& samples,
                                       std::uintmax_t most_bytes) {
  std::vector<std::string> files;
  if (samples.empty()) return files;
  for (const std::filesystem::path& file : gltf_files(samples)) {
    if (std::filesystem::file_size(file) > most_bytes) continue;
    std::ifstream stream(file, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return files;
}

}  // namespace elbowroom::test
