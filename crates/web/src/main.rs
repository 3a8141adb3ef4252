//! The bundle's entry point.

fn main() {
    web::start();
}
