#pragma once
#include <array>
#include <functional>
#include <streambuf>
#include <string_view>

namespace espalier::sim {

/// What a std::ostream writes into when its bytes shall be seen as they pass: hands them over in pieces, in
/// order. Cannot be sought in. Flush the stream before what was handed over is looked at.
class ByteSink : public std::streambuf {
 public:
  explicit ByteSink(std::function<void(std::string_view)> take) : take_(std::move(take)) { clear(); }

 protected:
  int_type overflow(int_type c) override {
    sync();
    return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                           : sputc(traits_type::to_char_type(c));
  }
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    if (count <= epptr() - pptr()) return std::streambuf::xsputn(bytes, count);
    sync();
    take_({bytes, static_cast<std::size_t>(count)});
    return count;
  }
  int sync() override {
    const std::string_view waiting(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    clear();
    take_(waiting);
    return 0;
  }

 private:
  void clear() { setp(room_.data(), room_.data() + room_.size()); }

  std::function<void(std::string_view)> take_;
  std::array<char, 16384> room_;
};

}  // namespace espalier::sim
