#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hostile/limited_program.hpp"

namespace holdfast::tests {

/// One hostile input: a command line and the files that lie where it runs.
struct HostileInput {
  std::vector<std::string> words;
  std::map<std::string, std::string> files;                             ///< name -> content
  std::function<void(const std::filesystem::path&)> prepare = nullptr;  ///< what is no plain file
  bool may_take_long = false;  ///< it may ask for much work; it must then stop when it is told to
};

/// Characters that a terminal shows as they are; others as \x and two digits.
inline std::string shown(const std::string& text, std::size_t longest) {
  constexpr const char* digits = "0123456789abcdef";
  std::string line;
  for (const char character : text.substr(0, longest)) {
    const auto code = static_cast<unsigned char>(character);
    const bool plain = (code >= 0x20 && code < 0x7F && character != '\\') || character == '\n';
    line += plain ? std::string(1, character)
                  : std::string("\\x") + digits[code >> 4U] + digits[code & 15U];
  }
  if (text.size() > longest) line += "… (" + std::to_string(text.size()) + " bytes)";
  return line;
}

/// A word as bash reads it.
inline std::string quoted(const std::string& word) {
  const std::string plain = shown(word, 400);
  if (!plain.empty() && plain == word &&
      plain.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                              "-_=:./,+") == std::string::npos)
    return plain;
  std::string text = "$'";
  for (const char character : plain) {
    if (character == '\n') {
      text += "\\n";
    } else {
      text += (character == '\'' ? "\\'" : std::string(1, character));
    }
  }
  return text + "'";
}

inline std::string described(const HostileInput& input) {
  std::string text = "holdfast";
  for (const std::string& word : input.words) text += " " + quoted(word);
  for (const auto& [name, content] : input.files)
    text += "\n--- " + quoted(name) + "\n" + shown(content, 3000);
  return text + "\n---";
}

/// What lies in a folder, by name: of a file its content, of anything else its kind.
inline std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  std::error_code ignored;
  std::filesystem::recursive_directory_iterator entry(folder, ignored), end;
  for (; !ignored && entry != end; entry.increment(ignored)) {
    const auto status = entry->symlink_status(ignored);
    const bool file = std::filesystem::is_regular_file(status);
    contents[entry->path().lexically_relative(folder).string()] =
        file ? read_text(entry->path()) : "kind " + std::to_string(static_cast<int>(status.type()));
  }
  return contents;
}

/// The folders that one input after another is run in.
class HostileScene {
 public:
  explicit HostileScene(const HostileInput& input) {
    for (const char* name : {"work", "tmp"}) std::filesystem::create_directory(folder_ / name);
    for (const auto& [name, content] : input.files) {
      std::filesystem::create_directories((work() / name).parent_path());
      write_text(work() / name, content);
    }
    if (input.prepare) input.prepare(work());
    before_ = contents_of(work());
  }

  std::filesystem::path work() const { return folder_ / "work"; }
  const std::filesystem::path& place() const { return folder_.path(); }

  /// What the program has changed in the folder it ran in, in words; empty for nothing. The lock of
  /// a work store may stay with them.
  std::string changes() const {
    const auto after = contents_of(work());
    std::string text;
    for (const auto& [name, content] : after) {
      const auto old = before_.find(name);
      if (old == before_.end() && !is_lock(name)) text += " new " + quoted(name);
      if (old != before_.end() && old->second != content) text += " changed " + quoted(name);
    }
    for (const auto& entry : before_)
      if (after.count(entry.first) == 0) text += " gone " + quoted(entry.first);
    return text;
  }

  /// Files that the program writes under another name first, in the folder or beside it.
  std::string temporary_files() const {
    std::string text;
    for (const auto& entry : contents_of(folder_ / "tmp")) text += " tmp/" + quoted(entry.first);
    for (const auto& entry : contents_of(work())) {
      const std::string name = std::filesystem::path(entry.first).filename().string();
      const bool temporary = name.rfind(".holdfast-", 0) == 0;
      if (temporary && before_.count(entry.first) == 0) text += " " + quoted(entry.first);
    }
    return text;
  }

 private:
  bool is_lock(const std::string& name) const {
    const std::filesystem::path path = name;
    return path.filename() == "lock" && path.parent_path().extension() == ".zarr" &&
           before_.count(path.parent_path().string()) > 0;
  }

  TemporaryFolder folder_;
  std::map<std::string, std::string> before_;
};

/// Whether a line tells how far a job is: "sweep: 2/2 cells, 1391 cells/s, 0.0 s".
inline bool is_progress(const std::string& line) {
  return line.find("/s, ") != std::string::npos && line.rfind("holdfast: ", 0) != 0;
}

/// Lines of standard error: warnings, and others.
struct ErrorLines {
  std::size_t warnings = 0;
  std::size_t others = 0;
  std::string strange;  ///< the first that the program would not write
};

/// @param words  the command line, on which --progress may ask for lines of its own
inline ErrorLines error_lines_of(const std::string& errors, const std::vector<std::string>& words) {
  const bool progress = std::find(words.begin(), words.end(), "--progress") != words.end();
  ErrorLines lines;
  std::istringstream stream(errors);
  for (std::string line; std::getline(stream, line);) {
    if (progress && is_progress(line)) continue;
    const bool warning = line.rfind("holdfast: warning: ", 0) == 0;
    ++(warning ? lines.warnings : lines.others);
    if (line.rfind("holdfast: ", 0) != 0 && lines.strange.empty()) lines.strange = line;
  }
  if (!errors.empty() && errors.back() != '\n') lines.strange = "no end of the last line";
  return lines;
}

}  // namespace holdfast::tests
