#pragma once
#include <string_view>

/// The one way out for all that the program says. What a terminal would obey instead of showing it, wherever
/// it comes from, leaves as an escape, and no line is longer than somebody reads.
///
/// Results go to standard output, and a program whose result is lost has failed. Everything else goes to
/// standard error, and where nobody can hear it the work is none the worse.
namespace espalier::cli {

/// Gives standard input, output and error, as far as they are closed, something that can neither be read nor
/// written, so that no file that is opened later becomes one of them. Comes before anything else.
void keepStandardStreams();

/// A result: text of lines, in which a line break is one.
void print(std::string_view text);
/// A result: JSON, as other bytes of the same values.
void printJson(std::string_view json);

/// A line on standard error.
void say(std::string_view line);

/// On a terminal: a line that stays until something else is said in its place.
void sayForNow(std::string_view line);
/// Takes that line away.
void unsay();

/// The exit status of a program that ends now with this one: kFailed in place of 0, and why, where a result
/// was lost. Who closes a pipe, having read enough, needs no words.
int statusWithLoss(int status);

}  // namespace espalier::cli
