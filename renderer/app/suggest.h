// What to say when a word on the command line is unknown: what there is, and which of it was probably meant.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace crosslight {

// Number of letters to insert, delete, replace or swap with their neighbor to come from one word to the other.
std::size_t editDistance(const std::string& a, const std::string& b);

// The closest of `known`, first among equals; nothing when none is close (see kLettersPerTypo).
std::optional<std::string> nearest(const std::string& word, std::span<const std::string> known);

// "unknown method 'fong'; there are flat, gouraud, phong. Did you mean 'phong'?"
std::string unknownWord(const std::string& what, const std::string& word, std::span<const std::string> known);

std::string joined(std::span<const std::string> words, const std::string& separator);

}  // namespace crosslight
