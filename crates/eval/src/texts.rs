//! Texts: what they know, and lists of them joined.

use crate::answer::Answer;
use crate::evaluator::{Evaluator, Result};
use crate::fault::Fault;
use crate::numerals::read_number;
use crate::operate::{finite, fits};
use drawing::metrics;
use kernel::builtin::TextMessage;

/// So many letters are made in the time of a step.
const LETTERS: u64 = 16;

impl<'a> Evaluator<'a> {
    /// Sends a text what every text knows.
    pub(crate) fn send_text(
        &self,
        message: TextMessage,
        text: &str,
        arguments: &[Answer<'a>],
    ) -> Result<Answer<'a>> {
        let other = |at: usize| self.letters(&arguments[at]);
        self.burn_for_letters(text.len())?;
        match message {
            TextMessage::Number => read_number(text)
                .map(Answer::plain)
                .ok_or_else(|| Fault::no_answer(format!("`{text}` is no number"))),
            TextMessage::Length => Ok(Answer::plain(text.chars().count() as f64)),
            TextMessage::Width => {
                let (size, dimension) = self.number(&arguments[0])?;
                finite(metrics::text_width(text, size), dimension)
            }
            TextMessage::Height => {
                let (size, dimension) = self.number(&arguments[0])?;
                finite(metrics::text_height(text, size), dimension)
            }
            TextMessage::Text => Ok(Answer::text(text)),
            TextMessage::Upper => Ok(Answer::text(&text.to_uppercase())),
            TextMessage::Lower => Ok(Answer::text(&text.to_lowercase())),
            TextMessage::Trim => Ok(Answer::text(text.trim())),
            TextMessage::Characters => {
                self.burn_several(text.chars().count() as u64)?;
                let mut room = [0; 4];
                let each = text.chars().map(|c| Answer::text(c.encode_utf8(&mut room)));
                Ok(Answer::List(each.collect()))
            }
            TextMessage::Split => self.split(text, other(0)?),
            TextMessage::Contains => Ok(Answer::Bool(text.contains(other(0)?))),
            TextMessage::StartsWith => Ok(Answer::Bool(text.starts_with(other(0)?))),
            TextMessage::EndsWith => Ok(Answer::Bool(text.ends_with(other(0)?))),
            TextMessage::Replaced => {
                let (old, new) = (not_empty(other(0)?)?, other(1)?);
                let times = text.matches(old).count();
                let added = times.saturating_mul(new.len());
                self.room_for(added.saturating_add(text.len() - times * old.len()))?;
                Ok(Answer::text(&text.replace(old, new)))
            }
            TextMessage::Padded => {
                Ok(Answer::text(&format!("{text}{}", self.pad(text, arguments)?)))
            }
            TextMessage::RightAligned => {
                Ok(Answer::text(&format!("{}{text}", self.pad(text, arguments)?)))
            }
            TextMessage::Red | TextMessage::Green | TextMessage::Blue => {
                let unknown = || Fault::no_answer(format!("`{text}` is no colour"));
                let [red, green, blue] = drawing::components(text).ok_or_else(unknown)?;
                Ok(Answer::plain(match message {
                    TextMessage::Red => red,
                    TextMessage::Green => green,
                    _ => blue,
                }))
            }
        }
    }

    /// Joins texts, with another one between them where that is said.
    pub(crate) fn join(
        &self,
        items: &[Answer<'a>],
        with: Option<&Answer<'a>>,
    ) -> Result<Answer<'a>> {
        let with = with.map_or(Ok(""), |with| self.letters(with))?;
        let texts: Vec<&str> = items.iter().map(|i| self.letters(i)).collect::<Result<_>>()?;
        let between = with.len().saturating_mul(texts.len().saturating_sub(1));
        self.room_for(texts.iter().map(|text| text.len()).fold(between, usize::saturating_add))?;
        Ok(Answer::text(&texts.join(with)))
    }

    /// What stands between the places where a text is; the words, where that is a space.
    fn split(&self, text: &str, by: &str) -> Result<Answer<'a>> {
        let pieces: Vec<&str> = match by {
            " " => text.split_whitespace().collect(),
            by => text.split(not_empty(by)?).collect(),
        };
        self.burn_several(pieces.len() as u64)?;
        Ok(Answer::List(pieces.into_iter().map(Answer::text).collect()))
    }

    /// What a text lacks to be as long as is wanted.
    fn pad(&self, text: &str, arguments: &[Answer<'a>]) -> Result<String> {
        let with = arguments.get(1).map_or(Ok(" "), |with| self.letters(with))?;
        if with.chars().count() != 1 {
            return Err(Fault::no_answer(format!("`{with}` where one character is wanted")));
        }
        let wanted = usize::try_from(self.whole(&arguments[0])?).unwrap_or(0);
        let lacking = wanted.saturating_sub(text.chars().count());
        self.room_for(text.len().saturating_add(lacking.saturating_mul(with.len())))?;
        Ok(with.repeat(lacking))
    }

    fn letters<'t>(&self, answer: &'t Answer<'a>) -> Result<&'t str> {
        match answer {
            Answer::Text(text) => Ok(text),
            other => Err(Fault::wrong(format!("{} where a text is wanted", self.kind(other)))),
        }
    }

    /// Counts the work of making a text of so many letters.
    ///
    /// # Errors
    /// It is too long to be made.
    fn room_for(&self, length: usize) -> Result<()> {
        fits(length)?;
        self.burn_for_letters(length)
    }

    fn burn_for_letters(&self, count: usize) -> Result<()> {
        self.burn_several(1 + count as u64 / LETTERS)
    }
}

/// Refuses the text that stands everywhere in every text.
fn not_empty(text: &str) -> Result<&str> {
    match text.is_empty() {
        true => Err(Fault::no_answer("an empty text stands everywhere")),
        false => Ok(text),
    }
}
