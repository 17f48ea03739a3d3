#include "cli/completion.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <string_view>
#include <variant>

namespace skein {
namespace {

constexpr std::string_view script_start =
    R"bash(# Completes the command line of skein in bash; made by 'skein completion bash'.

)bash";

// Behind functions that know verbs and keys: _skein_verbs, _skein_options VERB, _skein_value VERB OPTION-OR-PLACE,
// _skein_keys and _skein_key_words KEY. Each prints words, one a line.
constexpr std::string_view script_end = R"bash(
# Words that begin as the current one does. What bash has split off before it ("key=") is no part of a reply.
_skein_reply() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
  [[ -n $lead && $COMP_WORDBREAKS != *=* ]] && COMPREPLY=("${COMPREPLY[@]/#/$lead}")
  [[ ${COMPREPLY[0]-} == *= ]] && compopt -o nospace 2> /dev/null
}

_skein_reply_paths() {
  mapfile -t COMPREPLY < <(compgen "$1" -- "$current")
  [[ -n $lead && $COMP_WORDBREAKS != *=* ]] && COMPREPLY=("${COMPREPLY[@]/#/$lead}")
  compopt -o filenames 2> /dev/null
}

# KEY=VALUE, also fiber[1].KEY=VALUE.
_skein_reply_keys() {
  local index= keys
  [[ $current =~ ^[a-z_]+(\[[0-9]+\])\. ]] && index=${BASH_REMATCH[1]}
  if [[ $current == *=* ]]; then
    local key=${current%%=*}
    lead+=$key= current=${current#*=}
    _skein_reply "$(_skein_key_words "${key/"$index"/}")"
    return
  fi
  keys=$(_skein_keys)
  _skein_reply "${keys//./"$index".}"
}

_skein() {
  COMPREPLY=()
  # The words as skein gets them: bash has split them at "=".
  local -a words=()
  local i word is_open=
  for ((i = 1; i <= COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if ((${#words[@]} > 0)) && [[ $word == = || -n $is_open ]]; then words[-1]+=$word; else words+=("$word"); fi
    if [[ $word == = ]]; then is_open=yes; else is_open=; fi
  done
  local current=${words[-1]} lead= wanted= place=1
  if ((${#words[@]} == 1)); then
    _skein_reply "$(_skein_verbs)"
    return
  fi
  for word in "${words[@]:1:${#words[@]}-2}"; do
    if [[ -n $wanted ]]; then
      wanted=
    elif [[ $word == -* ]]; then
      [[ $word == *=* ]] || wanted=$(_skein_value "${words[0]}" "$word")
    else
      ((++place))
    fi
  done
  if [[ -z $wanted && $current == --*=* ]]; then
    lead=${current%%=*}= current=${current#*=}
    wanted=$(_skein_value "${words[0]}" "${lead%=}")
  elif [[ -z $wanted && $current == -* ]]; then
    _skein_reply "$(_skein_options "${words[0]}")"
    return
  elif [[ -z $wanted ]]; then
    wanted=$(_skein_value "${words[0]}" "$place")
  fi
  case $wanted in
    %file) _skein_reply_paths -f ;;
    %folder) _skein_reply_paths -d ;;
    %key) _skein_reply_keys ;;
    %verb) _skein_reply "$(_skein_verbs)" ;;
    %* | '') ;;
    *) _skein_reply "$wanted" ;;
  esac
}

complete -F _skein skein
)bash";

/// "-o,--output" -> "-o" and "--output"
std::vector<std::string> split_names(const std::string& names) {
  std::vector<std::string> parts(1);
  for (const char c : names) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// What _skein_value prints: words, a kind that script_end knows, or %other for what cannot be known.
std::string describe_value(const Argument& argument) {
  static const std::map<std::string, std::string> kinds = {
      {"SCENE", "%file"},    {"FILE", "%file"},     {"PICTURE", "%file"},
      {"DIR", "%folder"},    {"FOLDER", "%folder"}, {"RUN[@TIME]", "%folder"},
      {"KEY=VALUE", "%key"}, {"VERB", "%verb"},     {"time.end=LATER", "time.end="}};
  if (!argument.words.empty()) return fmt::format("{}", fmt::join(argument.words, "\\n"));
  const auto kind = kinds.find(argument.type_name);
  return kind == kinds.end() ? "%other" : kind->second;
}

std::string write_case(const std::string& pattern, const std::string& printed) {
  return fmt::format("    {}) printf '%b\\n' '{}' ;;\n", pattern, printed);
}

std::string write_function(const std::string& name, const std::string& subject, const std::string& cases) {
  return fmt::format("{}() {{\n  case {} in\n{}  esac\n}}\n", name, subject, cases);
}

std::string list_options(const Verb& verb) {
  std::vector<std::string> options;
  for (const Argument& argument : verb.arguments) {
    if (!argument.is_option()) continue;
    for (const std::string& name : split_names(argument.names)) options.push_back(name);
  }
  options.insert(options.end(), {"-h", "--help"});
  return fmt::format("{}", fmt::join(options, "\\n"));
}

/// Of a verb's options that take a value, and of its places, counted from 1.
std::string write_value_cases(const Verb& verb) {
  std::string cases;
  int place = 0;
  for (const Argument& argument : verb.arguments) {
    if (std::holds_alternative<bool*>(argument.target)) continue;
    std::vector<std::string> patterns;
    if (argument.is_option())
      for (const std::string& name : split_names(argument.names)) patterns.push_back(verb.name + ":" + name);
    else
      patterns.push_back(fmt::format("{}:{}", verb.name, ++place));
    cases += write_case(fmt::format("{}", fmt::join(patterns, " | ")), describe_value(argument));
  }
  return cases;
}

std::string write_verb_functions(const std::vector<Verb>& verbs) {
  std::vector<std::string> first_words;
  std::string options, values;
  for (const Verb& verb : verbs) {
    first_words.push_back(verb.name);
    options += write_case(verb.name, list_options(verb));
    values += write_value_cases(verb);
  }
  first_words.insert(first_words.end(), {"-h", "--help", "-V", "--version"});
  return fmt::format("_skein_verbs() {{\n  printf '%b\\n' '{}'\n}}\n", fmt::join(first_words, "\\n")) +
         write_function("_skein_options", "$1", options) + write_function("_skein_value", "$1:$2", values);
}

std::string write_key_functions(const std::vector<KeyName>& keys) {
  std::vector<std::string> paths;
  std::string words;
  for (const KeyName& key : keys) {
    paths.push_back(key.path + "=");
    if (!key.words.empty()) words += write_case(key.path, fmt::format("{}", fmt::join(key.words, "\\n")));
  }
  return fmt::format("_skein_keys() {{\n  printf '%b\\n' '{}'\n}}\n", fmt::join(paths, "\\n")) +
         write_function("_skein_key_words", "$1", words);
}

}  // namespace

std::string write_bash_completion(const std::vector<Verb>& verbs, const std::vector<KeyName>& keys) {
  return std::string(script_start) + write_verb_functions(verbs) + write_key_functions(keys) + std::string(script_end);
}

}  // namespace skein
