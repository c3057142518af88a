//! What holds of every conversation.
