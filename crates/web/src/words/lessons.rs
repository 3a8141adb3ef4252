//! The words of lessons.

pub const LESSON: &str = "Lesson";
pub const LESSONS: &str = "Lessons";
pub const LESSON_BEGIN: &str = "Begin";
pub const LESSON_NEXT: &str = "Go on";
pub const LESSON_HINT: &str = "Hint";
pub const LESSON_SHOW: &str = "Show me";

pub fn lesson_offered(title: &str) -> String {
    format!("This document has a lesson: {title}.")
}
pub fn lesson_place(title: &str, at: u32, of: u32) -> String {
    format!("{title}: {at} of {of}")
}
pub fn lesson_over(title: &str) -> String {
    format!("{title}: done.")
}
pub fn lesson_next(title: &str) -> String {
    format!("Next: {title}")
}
