// Foolish questions made by hand: wrong units, ranges turned about, words of other jobs, files that
// are something else. foolish_inputs.txt says what comes of each, and what must be said of it.

#include "hostile/hostile_scene.hpp"

namespace holdfast::tests {
namespace {

/// A question and what it must come to: "2", "1", "warn" or "0", with a word of what is said.
struct Foolish {
  std::string outcome, word;
  HostileInput input;
};

/// The words of a line, of which quotes hold blanks together.
std::vector<std::string> unquoted_words(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> std::ws && !stream.eof(); words.push_back(word)) {
    if (stream.peek() == '"')
      stream >> std::quoted(word);
    else
      stream >> word;
  }
  return words;
}

/// A text with \n, \r, \t and \xHH as the characters that they stand for.
std::string unescaped(const std::string& text) {
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '\\' || k + 1 == text.size()) {
      result += text[k];
      continue;
    }
    const char kind = text[++k];
    if (kind == 'x') {
      result += static_cast<char>(std::stoi(text.substr(k + 1, 2), nullptr, 16));
      k += 2;
    } else {
      result += kind == 'n' ? '\n' : kind == 'r' ? '\r' : '\t';
    }
  }
  return result;
}

Foolish foolish_of(const std::string& line) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 2) {
    end = parts.size() < 3 ? line.find("| ", begin) : std::string::npos;
    parts.push_back(line.substr(begin, end == std::string::npos ? end : end - begin));
    if (parts.size() < 4) parts.back().erase(parts.back().find_last_not_of(' ') + 1);
  }
  if (parts.size() < 3) throw std::runtime_error("not a foolish input: " + line);
  Foolish foolish{parts[0], parts[1], {}};
  foolish.input.words = unquoted_words(parts[2]);
  foolish.input.files["case.toml"] = parts.size() > 3 ? unescaped(parts[3]) : "";
  return foolish;
}

/// The questions under each heading.
const std::map<std::string, std::vector<Foolish>>& foolish_inputs() {
  static const auto inputs = [] {
    std::map<std::string, std::vector<Foolish>> by_heading;
    std::istringstream file(read_text(HOLDFAST_SOURCE_DIR "/tests/hostile/foolish_inputs.txt"));
    std::string heading;
    for (std::string line; std::getline(file, line);) {
      if (line.rfind("# --- ", 0) == 0) heading = line.substr(6);
      if (!line.empty() && line.front() != '#') by_heading[heading].push_back(foolish_of(line));
    }
    return by_heading;
  }();
  return inputs;
}

/// Whether an answer bears a number that no cable has, or none at all.
bool has_nonsense(const std::string& output) {
  std::string cell;
  for (const char character : output + ",") {
    const bool ends = character == ',' || character == '\n' || character == '\r';
    if (!ends) {
      cell += character;
      continue;
    }
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (!cell.empty() && *end == '\0' && !(std::abs(value) < 1e9)) return true;
    cell.clear();
  }
  return false;
}

std::string fault_of(const Foolish& foolish, const LimitedEnding& ending) {
  if (ending.killed || ending.ended_by_signal != 0) return "did not end by itself";
  const int wanted = foolish.outcome == "2" ? 2 : foolish.outcome == "1" ? 1 : 0;
  if (ending.exit_code != wanted) return "gave the exit code " + std::to_string(ending.exit_code);
  const ErrorLines lines = error_lines_of(ending.errors, foolish.input.words);
  if (!lines.strange.empty()) return "wrote a strange line";
  if (lines.others != (wanted == 0 ? 0 : 1)) return "wrote not one line of errors";
  if (foolish.outcome == "warn" && lines.warnings == 0) return "did not warn";
  const std::string& said = foolish.outcome == "0" ? ending.output : ending.errors;
  if (said.find(foolish.word) == std::string::npos) return "did not say '" + foolish.word + "'";
  if (foolish.outcome == "0" && has_nonsense(ending.output)) return "said nonsense";
  return "";
}

class FoolishInputs : public testing::TestWithParam<std::string> {};

TEST_P(FoolishInputs, AreRefusedOrNamed) {
  for (const Foolish& foolish : foolish_inputs().at(GetParam())) {
    const HostileScene scene(foolish.input);
    Limits limits;
    limits.patience = std::chrono::seconds(is_sanitized ? 120 : 10);
    limits.processor_seconds = is_sanitized ? 240 : 20;
    const LimitedEnding ending = limited_run(foolish.input.words, scene.place(), limits);
    const std::string fault = fault_of(foolish, ending);
    if (fault.empty()) continue;
    ADD_FAILURE() << "the program " << fault << " (wanted " << foolish.outcome << ")\n"
                  << described(foolish.input) << "\nstandard error:\n"
                  << shown(ending.errors, 2000) << "\nstandard output:\n"
                  << shown(ending.output, 300);
  }
}

std::vector<std::string> headings() {
  std::vector<std::string> names;
  for (const auto& entry : foolish_inputs()) names.push_back(entry.first);
  return names;
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name;
  for (const char character : info.param)
    if (std::isalnum(static_cast<unsigned char>(character)) != 0) name += character;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Headings, FoolishInputs, testing::ValuesIn(headings()), name_of);

}  // namespace
}  // namespace holdfast::tests
