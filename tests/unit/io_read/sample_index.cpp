// SPDX-License-Identifier: MIT
#include "tests/unit/io_read/sample_index.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>

namespace elbowroom::test {
namespace {

bool is_gltf(const std::filesystem::path& path) {
  static const std::set<std::string> kExtensions{".gltf", ".glb", ".vrm", ".vrma"};
  return kExtensions.count(path.extension().string()) > 0;
}

int to_number(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ','), text.end());
  return std::stoi(text);
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] != '|') {
      cell += row[i];
      continue;
    }
    const auto first = cell.find_first_not_of(' ');
    const auto last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    cell.clear();
  }
  return cells;
}

bool is_number_part(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; }

// "Idle 2s, Walk, slow 1.25s": each clip ends in its length, and names may hold commas.
int count_clips(const std::string& cell) {
  int count = 0;
  for (std::size_t at = 0; (at = cell.find('s', at)) != std::string::npos; ++at) {
    const bool ends = at + 1 == cell.size() || cell[at + 1] == ',';
    if (ends && at > 0 && cell[at - 1] >= '0' && cell[at - 1] <= '9') {
      std::size_t first = at;
      while (first > 0 && is_number_part(cell[first - 1])) --first;
      if (first > 0 && cell[first - 1] == ' ') ++count;
    }
  }
  return count;
}

// The number that stands before `word`: "4,672 triangles".
std::optional<int> number_before(const std::string& line, const std::string& word) {
  const std::size_t end = line.find(word);
  if (end == std::string::npos) return std::nullopt;
  std::size_t first = end;
  while (first > 0 &&
         (std::isdigit(static_cast<unsigned char>(line[first - 1])) || line[first - 1] == ',')) {
    --first;
  }
  if (first == end) return std::nullopt;
  return to_number(line.substr(first, end - first));
}

void read_list_line(const std::string& line, SampleFacts& facts) {
  if (const auto triangles = number_before(line, " triangles")) facts.triangles = triangles;
  if (line.rfind("- joints: ", 0) == 0) facts.joints = number_before(line, " in ");
  if (const auto clips = number_before(line, " clip(s)")) facts.clips = clips;
  if (line.rfind("- no skin", 0) == 0) facts.joints = 0;
  if (line.rfind("- no animation", 0) == 0) facts.clips = 0;
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    if (line.find(std::string("required: ") + name) != std::string::npos) facts.compressed = true;
  }
}

void read_table_row(const std::vector<std::string>& header, const std::vector<std::string>& cells,
                    SampleFacts& facts) {
  for (std::size_t c = 0; c < std::min(header.size(), cells.size()); ++c) {
    const std::string& cell = cells[c];
    const bool number = !cell.empty() && std::isdigit(static_cast<unsigned char>(cell[0]));
    if (header[c] == "file") facts.file = cell;
    if ((header[c] == "tris" || header[c] == "triangles") && number) {
      facts.triangles = to_number(cell.substr(0, cell.find(' ')));
    }
    if (header[c] == "joints")
      facts.joints = number ? to_number(cell.substr(0, cell.find(' '))) : 0;
    if (header[c] == "clips") facts.clips = count_clips(" " + cell);
  }
}

}  // namespace

std::vector<SampleFacts> read_sample_index(const std::filesystem::path& samples) {
  std::vector<SampleFacts> all;
  std::ifstream stream(samples / "INDEX.md");
  std::vector<std::string> header;
  bool in_list = false;
  const auto wanted = [](const std::string& file) {
    return is_gltf(file) && file.rfind("malformed/", 0) != 0;
  };
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("#", 0) == 0) {
      in_list = line.rfind("### ", 0) == 0 && wanted(line.substr(4));
      header.clear();
      if (!in_list) continue;
      all.emplace_back();
      all.back().file = line.substr(4);
    } else if (line.rfind("|", 0) == 0) {
      const std::vector<std::string> cells = cells_of(line);
      if (header.empty()) {
        header = cells;
        continue;
      }
      SampleFacts facts;
      read_table_row(header, cells, facts);
      if (wanted(facts.file)) all.push_back(facts);
    } else if (in_list) {
      read_list_line(line, all.back());
    }
  }
  return all;
}

std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && is_gltf(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace elbowroom::test
