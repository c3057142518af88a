// An adapter that skips everything. Fill in the ops that your library offers.
//
//     g++ -std=c++17 -Wall -Wextra -pedantic -o adapter adapter.cpp
//
// First comes what you write, then the loop over requests, then JSON.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using Bytes = std::vector<std::uint8_t>;

// Throw it where the library rejects its input, with one of the error classes.
struct Rejected : std::runtime_error {
    explicit Rejected(const std::string &detail, std::string fault = "unspecified")
        : std::runtime_error(detail), fault(std::move(fault)) {}
    std::string fault;
};

// Throw it where the library has nothing for the request, with the reason.
struct Skipped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// A value of a request.
class Json {
public:
    // Reads a whole text.
    static Json read(const std::string &text);

    bool has(const std::string &name) const { return find(name) != nullptr; }
    // A field of an object. Each of these throws if the value is of another kind.
    const Json &operator[](const std::string &name) const;
    const std::string &text() const;
    long number() const;
    Bytes bytes() const;
    const std::vector<Json> &list() const;

private:
    enum class Kind { other, number, text, list, object };

    const Json *find(const std::string &name) const;
    static Json value(const std::string &text, std::size_t &at);
    static std::string string(const std::string &text, std::size_t &at);

    Kind kind = Kind::other;
    long integer = 0;
    std::string characters;
    std::vector<std::string> names; // of an object's fields, whose values are `values`
    std::vector<Json> values;
};

// Bytes as hex digits.
std::string hex(const Bytes &bytes);
// A text as a JSON string.
std::string quoted(const std::string &text);

// An op takes the request and returns the object that `ok` holds, for example:
//
//     std::string crc(const Json &request)
//     {
//         const Bytes bytes = request["bytes"].bytes();
//         return "{\"crc\":" + std::to_string(my_library::crc(bytes)) + "}";
//     }
//
// and {"crc", crc} in OPS.

// A library that opens a port and talks with devices has the ops `open`, `call` and `close`, and is
// checked by `actucheck host`, for example:
//
//     std::unique_ptr<my_library::Port> port;
//
//     std::string close_port(const Json &)
//     {
//         port.reset();
//         return "{}";
//     }
//
//     std::string open_port(const Json &request)
//     {
//         port.reset();
//         const std::string &path = request["port"].text();
//         port = std::make_unique<my_library::Port>(path, request["baud"].number());
//         return "{}";
//     }
//
//     std::string call(const Json &request)
//     {
//         const Json &call = request["call"];
//         if (call["name"].text() != "read")
//             throw Skipped("no " + call["name"].text());
//         if (!port)
//             throw Rejected("no port is open", "port");
//         const long device = call["device"].number();
//         const long address = call["address"].number(), length = call["length"].number();
//         try {
//             const std::string data = quoted(hex(port->read(device, address, length)));
//             const std::string id = std::to_string(device);
//             return "{\"devices\":[{\"id\":" + id + ",\"data\":" + data + "}]}";
//         } catch (const my_library::Timeout &error) {
//             throw Rejected(error.what(), "timeout");
//         }
//     }
//
// and {"open", open_port}, {"call", call}, {"close", close_port} in OPS.

// A library with a class of a device, which takes bytes and answers them, has the op `device` and the
// role `device`, and is checked by `actucheck device --adapter`, for example:
//
//     my_library::Servo servo(1);
//
//     std::string device(const Json &request)
//     {
//         const Bytes bytes = request["bytes"].bytes();
//         const Bytes answer = servo.hear(bytes, request["after_ms"].number());
//         return "{\"bytes\":" + quoted(hex(answer)) + "}";
//     }
//
// and {"device", device} in OPS.
using Op = std::function<std::string(const Json &)>;
const std::map<std::string, Op> OPS = {};

const std::string IMPLEMENTATION = R"({"name":"my_library","version":"0","language":"C++"})";
const std::vector<std::string> WIRES = {"dynamixel2"};
// A host builds requests and reads replies, a device the reverse; name both if it does both.
const std::vector<std::string> ROLES = {"host"};
// The longest packets that it builds and reads, in bytes: {"max_send":…,"max_receive":…}.
const std::string LIMITS = "{}";

namespace {

bool has(const std::vector<std::string> &names, const std::string &name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string listed(const std::vector<std::string> &names)
{
    std::string text;
    for (const std::string &name : names)
        text += (text.empty() ? "" : ",") + quoted(name);
    return "[" + text + "]";
}

std::string hello()
{
    std::vector<std::string> ops;
    for (const auto &op : OPS)
        ops.push_back(op.first);
    return R"({"protocol":4,"implementation":)" + IMPLEMENTATION + R"(,"roles":)" + listed(ROLES) +
           R"(,"wires":)" + listed(WIRES) + R"(,"ops":)" + listed(ops) + R"(,"limits":)" + LIMITS +
           "}";
}

// The role that does this; empty if both do.
std::string role(const Json &request)
{
    if (request["op"].text() == "device")
        return "device";
    const bool encodes = request["op"].text() == "encode";
    const bool builds = encodes || request.has("value") || request.has("message");
    const Json &of = request.has("message") ? request["message"] : request;
    bool is_request = false;
    if (encodes) {
        const std::string &kind = request["packet"]["kind"].text();
        is_request = kind == "instruction" || kind == "request";
    } else if (of.has("direction")) {
        is_request = of["direction"].text() == "request";
    } else {
        return "";
    }
    return is_request == builds ? "host" : "device";
}

std::string ok(const Json &request)
{
    const std::string &op = request["op"].text();
    if (op == "hello")
        return hello();
    const auto found = OPS.find(op);
    if (found == OPS.end())
        throw Skipped("no " + op);
    if (!has(WIRES, request["wire"].text()))
        throw Skipped("no " + request["wire"].text());
    const std::string who = role(request);
    if (!who.empty() && !has(ROLES, who))
        throw Skipped("the other role does this");
    return found->second(request);
}

std::string answer(const Json &request)
{
    try {
        return R"("ok":)" + ok(request);
    } catch (const Skipped &skipped) {
        return R"("skip":{"reason":)" + quoted(skipped.what()) + "}";
    } catch (const Rejected &rejected) {
        return R"("err":{"class":)" + quoted(rejected.fault) + R"(,"detail":)" +
               quoted(rejected.what()) + "}";
    } catch (const std::exception &error) { // what the library lets through is a finding
        return R"("err":{"class":"internal","detail":)" + quoted(error.what()) + "}";
    } catch (...) {
        return R"("err":{"class":"internal","detail":"an exception without a text"})";
    }
}

} // namespace

int main()
try {
    std::ios::sync_with_stdio(false);
    std::string line;
    while (std::getline(std::cin, line)) {
        const Json request = Json::read(line);
        if (request["op"].text() == "bye")
            break;
        const long id = request["id"].number();
        std::cout << R"({"id":)" << id << ',' << answer(request) << '}' << std::endl;
    }
    return 0;
} catch (const std::exception &error) {
    std::cerr << "no request: " << error.what() << '\n';
    return 1;
}

std::string hex(const Bytes &bytes)
{
    static const char DIGITS[] = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : bytes) {
        text += DIGITS[byte >> 4];
        text += DIGITS[byte & 15];
    }
    return text;
}

std::string quoted(const std::string &text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            quoted += '\\';
        if (static_cast<unsigned char>(c) < ' ')
            quoted += "\\u00" + hex({static_cast<std::uint8_t>(c)});
        else
            quoted += c;
    }
    return quoted + '"';
}

namespace {

[[noreturn]] void bad(const std::string &what)
{
    throw Rejected("bad request: " + what, "parameter");
}

// The next character that is no white space; 0 at the end.
char peek(const std::string &text, std::size_t &at)
{
    at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    return at < text.size() ? text[at] : '\0';
}

bool take(const std::string &text, std::size_t &at, char c)
{
    const bool found = peek(text, at) == c;
    at += found ? 1 : 0;
    return found;
}

// A code point up to U+FFFF as UTF-8.
std::string utf8(unsigned long code)
{
    const auto byte = [](unsigned long value) { return static_cast<char>(value); };
    if (code < 0x80)
        return {byte(code)};
    if (code < 0x800)
        return {byte(0xC0 | code >> 6), byte(0x80 | (code & 0x3F))};
    return {byte(0xE0 | code >> 12), byte(0x80 | (code >> 6 & 0x3F)), byte(0x80 | (code & 0x3F))};
}

} // namespace

Json Json::read(const std::string &text)
{
    std::size_t at = 0;
    Json json = value(text, at);
    if (peek(text, at) != '\0')
        bad("text after its end");
    return json;
}

Json Json::value(const std::string &text, std::size_t &at)
{
    Json json;
    const char first = peek(text, at);
    if (first == '"') {
        json.kind = Kind::text;
        json.characters = string(text, at);
    } else if (first == '[' || first == '{') {
        const bool is_object = first == '{';
        const char close = is_object ? '}' : ']';
        json.kind = is_object ? Kind::object : Kind::list;
        at++;
        bool more = !take(text, at, close);
        while (more) {
            if (is_object) {
                peek(text, at);
                json.names.push_back(string(text, at));
                if (!take(text, at, ':'))
                    bad("no `:`");
            }
            json.values.push_back(value(text, at));
            more = take(text, at, ',');
            if (!more && !take(text, at, close))
                bad("no end");
        }
    } else {
        const std::size_t end = std::min(text.find_first_of(",]} \t\r\n", at), text.size());
        const std::string word = text.substr(at, end - at);
        if (word.empty())
            bad("no value");
        if (word.find_first_not_of("-0123456789") == std::string::npos) {
            json.kind = Kind::number;
            json.integer = std::stol(word);
        }
        at = end;
    }
    return json;
}

std::string Json::string(const std::string &text, std::size_t &at)
{
    static const std::string ESCAPES = "ntrbf", MEANT = "\n\t\r\b\f";
    std::string read;
    if (!take(text, at, '"'))
        bad("no text");
    while (at < text.size() && text[at] != '"') {
        if (text[at] != '\\') {
            read += text[at++];
            continue;
        }
        const char c = at + 1 < text.size() ? text[at + 1] : '\0';
        at += 2;
        if (c == 'u') {
            read += utf8(std::stoul(text.substr(std::min(at, text.size()), 4), nullptr, 16));
            at += 4;
        } else {
            const std::size_t escape = ESCAPES.find(c);
            read += escape == std::string::npos ? c : MEANT[escape];
        }
    }
    if (!take(text, at, '"'))
        bad("a text without an end");
    return read;
}

const Json *Json::find(const std::string &name) const
{
    for (std::size_t i = 0; i < names.size(); i++)
        if (names[i] == name)
            return &values[i];
    return nullptr;
}

const Json &Json::operator[](const std::string &name) const
{
    const Json *field = find(name);
    if (field == nullptr)
        bad(name);
    return *field;
}

const std::string &Json::text() const
{
    if (kind != Kind::text)
        bad("no text");
    return characters;
}

long Json::number() const
{
    if (kind != Kind::number)
        bad("no integer");
    return integer;
}

const std::vector<Json> &Json::list() const
{
    if (kind != Kind::list)
        bad("no list");
    return values;
}

Bytes Json::bytes() const
{
    static const std::string DIGITS = "0123456789abcdef";
    Bytes bytes;
    if (text().size() % 2 != 0)
        bad("no hex digits");
    for (std::size_t i = 0; i < text().size(); i += 2) {
        const std::size_t high = DIGITS.find(text()[i]), low = DIGITS.find(text()[i + 1]);
        if (high == std::string::npos || low == std::string::npos)
            bad("no hex digits");
        bytes.push_back(static_cast<std::uint8_t>(high << 4 | low));
    }
    return bytes;
}
