#!/usr/bin/env bash
# missing_includes.sh SOURCE: each file of reports/ and runner/ includes, itself or through the program's headers that it
# includes, what gives the types and functions that it names. The release preset compiles these files several at once, where
# a compiler does not miss an include that another file has.
#
# It reads words and understands no C++: a word is taken for a function of the program if a header declares it at the left
# edge, and the file calls it and declares nothing of that name.
set -euo pipefail
cd "$1"
mapfile -t files < <(find hinge fem mpm analytic reports runner -name '*.[ch]pp' | sort)
# Headers, any of which will do, and what they give in std.
given='
algorithm: adjacent_find all_of any_of binary_search clamp copy count count_if equal_range fill find find_if find_if_not lower_bound
algorithm: max max_element min min_element minmax minmax_element mismatch none_of partition ranges replace replace_if
algorithm: reverse rotate set_union sort stable_sort transform unique upper_bound
any: any any_cast
array: array
atomic: atomic
bit: bit_cast endian
cctype: isalnum isalpha isdigit isspace tolower toupper
charconv: from_chars to_chars
chrono: chrono
cmath: abs acos asin atan atan2 cbrt ceil copysign cos cosh erf erfc exp expm1 fabs floor fmod hypot isfinite isinf
cmath: isnan ldexp llround log log10 log1p log2 lround nan nextafter pow remainder round signbit sin sinh sqrt tan tanh
cmath: trunc
csignal: signal
condition_variable: condition_variable condition_variable_any
cstddef: max_align_t nullptr_t ptrdiff_t
cstddef cstdio cstdlib cstring string vector array: size_t
cstdint: int32_t int64_t uint16_t uint32_t uint64_t uint8_t uintmax_t
cstdio: ferror fflush fprintf fputs fwrite perror remove rename
cstdlib: abort exit getenv strtod
cstring: memcmp memcpy strcmp strerror strlen
deque: deque
exception stdexcept: current_exception exception exception_ptr rethrow_exception
filesystem: filesystem
fstream: ifstream ofstream
functional: function greater greater_equal less plus
initializer_list vector string map set: initializer_list
iomanip: setfill setprecision setw
iosfwd ostream iostream sstream fstream: istream ostream
iostream: cerr cin cout
istream iostream sstream fstream string: getline
iterator: istreambuf_iterator
iterator vector string map set: back_inserter begin distance end inserter next prev size
limits: numeric_limits
map: map multimap
memory: make_shared make_unique shared_ptr unique_ptr weak_ptr
mutex: lock_guard mutex scoped_lock unique_lock
numbers: numbers
numeric: accumulate inner_product iota reduce
optional: make_optional nullopt nullopt_t optional
ostream iostream sstream fstream: endl flush ios ios_base
set: set
span: span
sstream: istringstream ostringstream stringstream
stop_token thread: stop_token
stdexcept: domain_error invalid_argument logic_error out_of_range runtime_error
string: stod stoi string to_string
string string_view: string_view
system_error: generic_category system_category system_error
system_error filesystem charconv: errc error_code
thread: jthread this_thread thread
tuple: apply make_tuple tie tuple tuple_size_v
type_traits: conditional_t decay_t enable_if_t invoke_result_t is_base_of_v is_same_v remove_cvref_t type_identity_t
utility algorithm map vector string: exchange forward make_pair move pair swap
variant: get_if holds_alternative monostate variant variant_size_v visit
variant tuple utility array map: get
vector: vector
vector string map set: erase erase_if
'
missing=$(awk -v given="$given" '
  BEGIN {
    lines = split(given, line, "\n")
    for (l = 1; l <= lines; ++l)
      if (split(line[l], half, ": ") == 2)
        for (k = split(half[2], list, " "); k > 0; --k) gives["std::" list[k]] = gives["std::" list[k]] " " half[1]
    gives["fmt::"] = " fmt/core.h fmt/format.h"
    gives["toml::"] = " toml++/toml.h"; gives["pugi::"] = " pugixml.hpp"; gives["nlohmann::"] = " nlohmann/json.hpp"
    gives["mu::"] = " muParser.h"; gives["CLI::"] = " CLI/CLI.hpp"
  }
  FNR == 1 { file = FILENAME; file_at[++file_count] = file; is_header = file ~ /hpp$/; raw = 0 }
  /^#include/ { name = $2; gsub(/[<>"]/, "", name); included[file] = included[file] " " name; next }
  /[ (={,]R"[a-z]*\(/ { raw = 1 }
  raw { if (/\)[a-z]*"/) raw = 0; next }
  {
    text = $0
    gsub(/\\./, "", text); gsub(/"[^"]*"/, "\"\"", text); sub(/\/\/.*/, "", text)
    # Not a declaration alone, of which the definition stands elsewhere.
    if (match(text, /^ *(template <[^;]*> )?(struct|class|enum class|enum|concept|using) [A-Z][A-Za-z0-9]*/)) {
      rest = substr(text, RSTART + RLENGTH)
      name = substr(text, RSTART, RLENGTH); sub(/.* /, "", name)
      if (is_header && rest !~ /^( : [a-z_0-9:]+)?;/) {
        if (text ~ /^ /) within[name] = within[name] " " file
        else gives[name] = gives[name] " " file
      }
    } else if (is_header && text ~ /^[A-Za-z:\[]/ && text !~ /^(static_assert|namespace)/) {
      rest = text
      while (match(rest, /[ &*>][a-z][a-z_0-9]*\(/)) {
        name = substr(rest, RSTART + 1, RLENGTH - 2)
        if (name != "requires") { gives[name] = gives[name] " " file; break }
        rest = substr(rest, RSTART + RLENGTH)
      }
    }
    text_of[file] = text_of[file] " " text
  }
  function reach(file, whole,   k, count, list) {
    count = split(included[file], list, " ")
    for (k = 1; k <= count; ++k)
      if (!((whole, list[k]) in has)) { has[whole, list[k]] = 1; reach(list[k], whole) }
  }
  function declared_in(rest,   part, before) {
    split("", own)
    whole = rest
    while (match(rest, /[A-Za-z_0-9:<>&*\]]+ [&*]?[A-Za-z_0-9]+ *[\[({=;,):]/)) {
      part = substr(rest, RSTART, RLENGTH); rest = substr(rest, RSTART + RLENGTH - 1)
      before = part; sub(/ .*/, "", before); sub(/^[^ ]* [&*]?/, "", part); sub(/ *.$/, "", part)
      if (before ~ /^(return|throw|case|else|and|or|not|co_return|new|delete)$/) continue
      if (before !~ /^[:<>*&]+$/ || before ~ /^>+[&*]$/) own[part] = 1
    }
    while (match(whole, /\(\*[a-z_0-9]+\)/)) {
      own[substr(whole, RSTART + 2, RLENGTH - 3)] = 1
      whole = substr(whole, RSTART + RLENGTH)
    }
  }
  END {
    for (f = 1; f <= file_count; ++f) {
      file = file_at[f]
      if (file !~ /^(reports|runner)\//) continue
      has[file, file] = 1; reach(file, file)
      declared_in(text_of[file])
      split("", used); rest = text_of[file]; past = ""
      while (match(rest, /[A-Za-z_][A-Za-z_0-9]*/)) {
        name = substr(rest, RSTART, RLENGTH)
        before = past substr(rest, RSTART > 40 ? RSTART - 40 : 1, RSTART > 40 ? 40 : RSTART - 1)
        rest = substr(rest, RSTART + RLENGTH)
        past = substr(before name, length(before name) > 60 ? length(before name) - 60 : 1)
        if (before ~ /(^|[^A-Za-z_:])std::$/) {
          if (("std::" name) in gives) used["std::" name] = 1
          else print file ": std::" name ", of which this test knows no header"
          continue
        }
        if ((name "::") in gives && rest ~ /^::/) { used[name "::"] = 1; continue }
        if (!(name in gives) || before ~ /(\.|->|[^A-Za-z_0-9]::|[A-Z][A-Za-z0-9]*::)$/) continue
        if (before ~ /(struct|class|enum|using|typename) $/) own[name] = 1
        else if (name ~ /^[A-Z]/ || rest ~ /^\(/) used[name] = 1
      }
      for (name in used) {
        found = name in own
        for (k = split(gives[name] within[name], list, " "); k > 0; --k) found = found || ((file, list[k]) in has)
        if (!found) print file ": " name ", of" gives[name]
      }
    }
  }' "${files[@]}" | sort -u)
[ -z "$missing" ] || { echo "named, and not included:"; echo "$missing"; }
echo "${#files[@]} files"
[ -z "$missing" ]
