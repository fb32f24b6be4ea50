//! Rust source as words and signs, without comments, literals and lifetimes.

/// An identifier, `::` or a single sign; `0` for any literal.
pub struct Token {
    pub text: String,
    pub line: usize,
}

/// The tokens of a file.
pub fn tokens(source: &str) -> Vec<Token> {
    let mut reader = Reader { rest: source.chars().collect(), at: 0, line: 1 };
    let mut tokens = Vec::new();
    while let Some(text) = reader.next() {
        if !text.is_empty() {
            tokens.push(Token { text, line: reader.line });
        }
    }
    tokens
}

/// Whether this is a name or keyword.
pub fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

struct Reader {
    rest: Vec<char>,
    at: usize,
    line: usize,
}

impl Reader {
    fn peek(&self, ahead: usize) -> char {
        self.rest.get(self.at + ahead).copied().unwrap_or('\0')
    }

    fn skip(&mut self, count: usize) {
        for _ in 0..count {
            self.line += usize::from(self.peek(0) == '\n');
            self.at += 1;
        }
    }

    /// Skips to after the next `end`; a backslash hides what follows it if `escapes`.
    fn skip_past(&mut self, end: &str, escapes: bool) {
        let end: Vec<char> = end.chars().collect();
        while self.at < self.rest.len() && !self.rest[self.at..].starts_with(&end) {
            self.skip(if escapes && self.peek(0) == '\\' { 2 } else { 1 });
        }
        self.skip(end.len());
    }

    /// The next token, empty for what is skipped; `None` at the end.
    fn next(&mut self) -> Option<String> {
        let c = *self.rest.get(self.at)?;
        let mut text = String::new();
        match (c, self.peek(1)) {
            ('/', '/') => self.skip_past("\n", false),
            ('/', '*') => self.skip_comment(),
            (':', ':') => {
                self.skip(2);
                text.push_str("::");
            }
            ('"', _) => {
                self.skip(1);
                self.skip_past("\"", true);
                text.push('0');
            }
            ('\'', _) => text.push_str(self.skip_quote()),
            _ if c.is_whitespace() => self.skip(1),
            _ if c.is_alphanumeric() || c == '_' => {
                let start = self.at;
                while self.peek(0).is_alphanumeric() || self.peek(0) == '_' {
                    self.skip(1);
                }
                text.extend(&self.rest[start..self.at]);
                if self.skip_string_after(&text) || c.is_numeric() {
                    text = "0".into();
                }
            }
            _ => {
                self.skip(1);
                text.push(c);
            }
        }
        Some(text)
    }

    /// Block comments nest.
    fn skip_comment(&mut self) {
        let mut depth = 0;
        while self.at < self.rest.len() {
            match (self.peek(0), self.peek(1)) {
                ('/', '*') => depth += 1,
                ('*', '/') => depth -= 1,
                _ => {
                    self.skip(1);
                    continue;
                }
            }
            self.skip(2);
            if depth == 0 {
                break;
            }
        }
    }

    /// A character, or a lifetime, which is no token.
    fn skip_quote(&mut self) -> &'static str {
        if self.peek(1) == '\\' || self.peek(2) == '\'' {
            self.skip(1);
            self.skip_past("'", true);
            return "0";
        }
        self.skip(1);
        while self.peek(0).is_alphanumeric() || self.peek(0) == '_' {
            self.skip(1);
        }
        ""
    }

    /// The string or character after a prefix such as `r` or `b`.
    fn skip_string_after(&mut self, prefix: &str) -> bool {
        let is_raw = matches!(prefix, "r" | "br" | "cr");
        let hashes = (0..).take_while(|&i| self.peek(i) == '#').count();
        if is_raw && self.peek(hashes) == '"' {
            self.skip(hashes + 1);
            self.skip_past(&format!("\"{}", "#".repeat(hashes)), false);
            return true;
        }
        match (prefix, self.peek(0)) {
            ("b" | "c", '"') => {
                self.skip(1);
                self.skip_past("\"", true);
            }
            ("b", '\'') => {
                self.skip_quote();
            }
            _ => return false,
        }
        true
    }
}
