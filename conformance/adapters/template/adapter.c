/* An adapter that skips everything. Fill in the ops that your library offers.
 *
 *     cc -std=c99 -Wall -Wextra -o adapter adapter.c
 *
 * First comes what you write, then what you can use for it, then the rest. */

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Answers: each op gives one of them, once. */
void ok(const char *format, ...);                        /* the object that `ok` holds */
/* One of the error classes, `unspecified` if the library does not say why; and what it says. */
void rejected(const char *fault, const char *detail);
void skipped(const char *reason);

/* Fields of a request or of an object in it; all of these point into the request's text. */
const char *field(const char *object, const char *name); /* NULL if it is not there */
const char *element(const char *array, size_t index);    /* NULL if there are no more */
int is(const char *value, const char *text);             /* whether a value is this text */
long number(const char *value);                          /* -1 if it is no number */
unsigned char *bytes(const char *value, size_t *count);  /* NULL if it is no hex; to be freed */

/* Bytes as hex digits; to be freed. */
char *hex(const unsigned char *data, size_t count);

/* A port in memory, for a library that sends and receives with functions of its user. It counts
 * the time, and waits for nothing. */
void memory_open(void);
void memory_send(const unsigned char *data, size_t count);
/* How many bytes it takes; 0 if none is there in so many milliseconds. */
size_t memory_receive(unsigned char *data, size_t size, long milliseconds);
long memory_now(void); /* in milliseconds */
/* Before and after a call: what the line plays in it, and what `ok` holds beside what was sent. */
void memory_begin(const char *request);
void memory_end(const char *format, ...);

/* An op takes the request, for example:
 *
 *     static void crc(const char *request)
 *     {
 *         size_t count;
 *         unsigned char *data = bytes(field(request, "bytes"), &count);
 *         if (data == NULL) {
 *             rejected("parameter", "bad request: bytes");
 *             return;
 *         }
 *         ok("{\"crc\":%u}", (unsigned)my_library_crc(data, count));
 *         free(data);
 *     }
 *
 * and {"crc", crc} at the head of OPS. */

/* A library that sends and receives with functions of its user has the ops `open`, `exchange` and
 * `close`, and is checked by `actucheck host`, for example:
 *
 *     static int is_open;
 *
 *     static void open_port(const char *request)
 *     {
 *         (void)request;
 *         memory_open();
 *         my_library_open(memory_send, memory_receive);
 *         is_open = 1;
 *         ok("{}");
 *     }
 *
 *     static void close_port(const char *request)
 *     {
 *         (void)request;
 *         is_open = 0;
 *         ok("{}");
 *     }
 *
 *     static void exchange(const char *request)
 *     {
 *         const char *call = field(request, "call");
 *         long device = number(field(call, "device"));
 *         long length = number(field(call, "length"));
 *         unsigned char data[256];
 *         if (!is(field(call, "name"), "read") || length > (long)sizeof data) {
 *             skipped("the library reads up to 256 bytes, and nothing else");
 *         } else if (!is_open) {
 *             rejected("port", "no port is open");
 *         } else {
 *             memory_begin(request);
 *             if (my_library_read(device, number(field(call, "address")), length, data)) {
 *                 char *text = hex(data, (size_t)length);
 *                 memory_end("\"devices\":[{\"id\":%ld,\"data\":\"%s\"}]", device, text);
 *                 free(text);
 *             } else {
 *                 memory_end("\"err\":{\"class\":\"timeout\",\"detail\":\"no answer\"}");
 *             }
 *         }
 *     }
 *
 * and {"open", open_port}, {"exchange", exchange}, {"close", close_port} at the head of OPS. */

/* A library of a device, which takes bytes and answers them, has the op `device` and the role
 * `device`, and is checked by `actucheck device --adapter`, for example:
 *
 *     static void device(const char *request)
 *     {
 *         unsigned char answer[4096];
 *         size_t count, size;
 *         unsigned char *data = bytes(field(request, "bytes"), &count);
 *         char *text;
 *         if (data == NULL) {
 *             rejected("parameter", "bad request: bytes");
 *             return;
 *         }
 *         size = my_servo_hear(data, count, number(field(request, "after_ms")), answer);
 *         text = hex(answer, size);
 *         ok("{\"bytes\":\"%s\"}", text);
 *         free(text);
 *         free(data);
 *     }
 *
 * and {"device", device} at the head of OPS. */

static const struct op {
    const char *name;
    void (*answer)(const char *request);
} OPS[] = {
    {NULL, NULL},
};

static const char IMPLEMENTATION[] =
    "{\"name\":\"my_library\",\"version\":\"0\",\"language\":\"C\"}";
static const char WIRE[] = "dynamixel2";
/* A host builds requests and reads replies, a device the reverse; name both if it does both. */
static const char *const ROLES[] = {"host", NULL};
/* The longest packets that it builds and reads, in bytes: {"max_send":...,"max_receive":...} */
static const char LIMITS[] = "{}";

/* The id of the request in hand. */
static long id;

void ok(const char *format, ...)
{
    va_list values;
    va_start(values, format);
    printf("{\"id\":%ld,\"ok\":", id);
    vprintf(format, values);
    printf("}\n");
    va_end(values);
}

/* Prints a text as a JSON string. */
static void print_text(const char *text)
{
    putchar('"');
    for (; *text != '\0'; text++) {
        if (*text == '"' || *text == '\\')
            printf("\\%c", *text);
        else if ((unsigned char)*text < ' ')
            printf("\\u%04x", (unsigned)(unsigned char)*text);
        else
            putchar(*text);
    }
    putchar('"');
}

void rejected(const char *fault, const char *detail)
{
    printf("{\"id\":%ld,\"err\":{\"class\":", id);
    print_text(fault);
    printf(",\"detail\":");
    print_text(detail);
    printf("}}\n");
}

void skipped(const char *reason)
{
    printf("{\"id\":%ld,\"skip\":{\"reason\":", id);
    print_text(reason);
    printf("}}\n");
}

/* The text from the first character that is no white space. */
static const char *skip_space(const char *at)
{
    return at + strspn(at, " \t\r\n");
}

/* The text after a value. */
static const char *skip_value(const char *at)
{
    int depth = 0;
    do {
        if (*at == '"') {
            for (at++; *at != '\0' && *at != '"'; at++)
                if (*at == '\\' && at[1] != '\0')
                    at++;
        } else if (*at == '{' || *at == '[') {
            depth++;
        } else if (*at == '}' || *at == ']') {
            depth--;
        } else if (depth == 0) {
            return at + strcspn(at, ",:}] \t\r\n");
        }
        if (*at != '\0')
            at++;
    } while (depth > 0 && *at != '\0');
    return at;
}

const char *field(const char *object, const char *name)
{
    size_t length = strlen(name);
    if (object == NULL || *object != '{')
        return NULL;
    object = skip_space(object + 1);
    while (*object == '"') {
        const char *key = object + 1, *end = skip_value(object);
        const char *value = skip_space(end);
        if (*value != ':')
            return NULL;
        value = skip_space(value + 1);
        if ((size_t)(end - key) == length + 1 && strncmp(key, name, length) == 0)
            return value;
        object = skip_space(skip_value(value));
        if (*object == ',')
            object = skip_space(object + 1);
    }
    return NULL;
}

const char *element(const char *array, size_t index)
{
    if (array == NULL || *array != '[')
        return NULL;
    array = skip_space(array + 1);
    while (*array != ']' && *array != '\0') {
        if (index-- == 0)
            return array;
        array = skip_space(skip_value(array));
        if (*array != ',')
            return NULL;
        array = skip_space(array + 1);
    }
    return NULL;
}

int is(const char *value, const char *text)
{
    size_t length = strlen(text);
    return value != NULL && *value == '"' && strncmp(value + 1, text, length) == 0 &&
           value[length + 1] == '"';
}

long number(const char *value)
{
    char *end;
    long result = value == NULL ? -1 : strtol(value, &end, 10);
    return value == NULL || end == value ? -1 : result;
}

/* Memory; without it the program ends. */
static void *allocated(void *old, size_t size)
{
    void *memory = realloc(old, size);
    if (memory == NULL) {
        fprintf(stderr, "adapter: out of memory\n");
        exit(EXIT_FAILURE);
    }
    return memory;
}

/* The value of a hex digit; -1 if it is none. */
static int digit(char c)
{
    static const char DIGITS[] = "0123456789abcdef";
    const char *found = c == '\0' ? NULL : strchr(DIGITS, c);
    return found == NULL ? -1 : (int)(found - DIGITS);
}

unsigned char *bytes(const char *value, size_t *count)
{
    size_t length, i;
    unsigned char *data;
    if (value == NULL || *value != '"')
        return NULL;
    length = strcspn(++value, "\"");
    if (length % 2 != 0)
        return NULL;
    data = allocated(NULL, length / 2 + 1);
    for (i = 0; i < length / 2; i++) {
        int high = digit(value[2 * i]), low = digit(value[2 * i + 1]);
        if (high < 0 || low < 0) {
            free(data);
            return NULL;
        }
        data[i] = (unsigned char)(high << 4 | low);
    }
    *count = length / 2;
    return data;
}

char *hex(const unsigned char *data, size_t count)
{
    char *text = allocated(NULL, 2 * count + 1);
    size_t i;
    text[0] = '\0';
    for (i = 0; i < count; i++)
        snprintf(text + 2 * i, 3, "%02x", data[i]);
    return text;
}

/* What the port in memory holds at most, each way. */
enum { ROOM = 1 << 16 };

/* Bytes that are not taken yet, in the order in which they are there. */
static struct {
    long at;
    unsigned char byte;
} coming[ROOM];
static size_t coming_count;

/* What was sent in this call: the bytes, and the pieces as JSON. */
static unsigned char sent[ROOM];
static size_t sent_count;
static char *pieces;

static long now, begun;
/* What the line plays in this call. */
static const char *play;
static size_t times;

long memory_now(void)
{
    return now;
}

/* Lets bytes be there at a time. */
static void arrive(long at, const char *value)
{
    size_t count = 0, i, place;
    unsigned char *data = bytes(value, &count);
    for (i = 0; i < count && coming_count < ROOM; i++) {
        for (place = coming_count++; place > 0 && coming[place - 1].at > at; place--)
            coming[place] = coming[place - 1];
        coming[place].at = at;
        coming[place].byte = data[i];
    }
    free(data);
}

void memory_open(void)
{
    now = 0;
    coming_count = 0;
}

void memory_begin(const char *request)
{
    play = request;
    times = 0;
    begun = now;
    sent_count = 0;
    pieces = allocated(pieces, 1);
    pieces[0] = '\0';
}

void memory_send(const unsigned char *data, size_t count)
{
    size_t frame_count = 0, length = strlen(pieces), i, chunk;
    unsigned char *frame = bytes(field(play, "frame"), &frame_count);
    const char *answer, *burst;
    char *text;
    if (count > ROOM - sent_count)
        count = ROOM - sent_count;
    text = hex(data, count);
    pieces = allocated(pieces, length + 2 * count + 64);
    if (count > 0)
        sprintf(pieces + length, "%s{\"at_ms\":%ld,\"bytes\":\"%s\"}", length > 0 ? "," : "",
                now - begun, text);
    for (i = 0; i < count; i++) {
        sent[sent_count++] = data[i];
        if (frame == NULL || sent_count < frame_count ||
            memcmp(sent + sent_count - frame_count, frame, frame_count) != 0)
            continue;
        answer = element(field(play, "answers"), times++);
        for (chunk = 0; (burst = element(answer, chunk)) != NULL; chunk++)
            arrive(now + number(field(burst, "after_ms")), field(burst, "bytes"));
    }
    free(frame);
    free(text);
}

size_t memory_receive(unsigned char *data, size_t size, long milliseconds)
{
    size_t count = 0;
    if (coming_count > 0 && coming[0].at <= now + milliseconds)
        now = coming[0].at > now ? coming[0].at : now;
    else
        now += milliseconds;
    while (count < size && count < coming_count && coming[count].at <= now) {
        data[count] = coming[count].byte;
        count++;
    }
    coming_count -= count;
    memmove(coming, coming + count, coming_count * sizeof coming[0]);
    return count;
}

void memory_end(const char *format, ...)
{
    const char *hurries = field(play, "hurries");
    va_list values;
    va_start(values, format);
    printf("{\"id\":%ld,\"ok\":{\"sent\":[%s],\"ms\":%ld,", id, pieces, now - begun);
    vprintf(format, values);
    printf("}}\n");
    va_end(values);
    if ((hurries == NULL || *hurries != 't') && coming_count > 0 &&
        coming[coming_count - 1].at > now)
        now = coming[coming_count - 1].at;
    arrive(now, field(play, "late"));
}

/* One line of standard input, however long, without its end; NULL at the end. */
static char *read_line(void)
{
    static char *line = NULL;
    static size_t size = 0;
    size_t length = 0;
    int c;
    while ((c = getchar()) != EOF && c != '\n') {
        if (length + 1 >= size)
            line = allocated(line, size = 2 * size + 256);
        line[length++] = (char)c;
    }
    if (c == EOF && length == 0)
        return NULL;
    if (line == NULL)
        line = allocated(line, size = 256);
    line[length] = '\0';
    return line;
}

static void say_hello(void)
{
    const char *const *role;
    const struct op *op;
    printf("{\"id\":%ld,\"ok\":{\"protocol\":4,\"implementation\":%s", id, IMPLEMENTATION);
    printf(",\"roles\":[");
    for (role = ROLES; *role != NULL; role++)
        printf("%s\"%s\"", role == ROLES ? "" : ",", *role);
    printf("],\"wires\":[\"%s\"],\"ops\":[", WIRE);
    for (op = OPS; op->name != NULL; op++)
        printf("%s\"%s\"", op == OPS ? "" : ",", op->name);
    printf("],\"limits\":%s}}\n", LIMITS);
}

/* Whether the library plays the role that does this. */
static int plays(const char *request)
{
    const char *const *role = ROLES;
    const char *kind = field(field(request, "packet"), "kind");
    const char *message = field(request, "message");
    const char *direction = field(message == NULL ? request : message, "direction");
    int encodes = is(field(request, "op"), "encode");
    int builds = encodes || message != NULL || field(request, "value") != NULL;
    int is_request = encodes ? is(kind, "instruction") || is(kind, "request")
                             : is(direction, "request");
    const char *who = is_request == builds ? "host" : "device";
    if (is(field(request, "op"), "device"))
        who = "device";
    else if (!encodes && direction == NULL)
        return 1;
    while (*role != NULL && strcmp(*role, who) != 0)
        role++;
    return *role != NULL;
}

static void answer(const char *request)
{
    const struct op *op = OPS;
    const char *name = field(request, "op");
    if (is(name, "hello")) {
        say_hello();
        return;
    }
    while (op->name != NULL && !is(name, op->name))
        op++;
    if (op->name == NULL)
        skipped("the adapter has no such op");
    else if (!is(field(request, "wire"), WIRE))
        skipped("the library does not speak this wire");
    else if (!plays(request))
        skipped("the other role does this");
    else
        op->answer(request);
}

int main(void)
{
    const char *request;
    while ((request = read_line()) != NULL && !is(field(request, "op"), "bye")) {
        id = number(field(request, "id"));
        answer(request);
        fflush(stdout);
    }
    return EXIT_SUCCESS;
}
